export const token: string;
export function fill(template: string, document: unknown): string;
