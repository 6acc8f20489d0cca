import { defineConfig } from "vitest/config";
import { viteSingleFile } from "vite-plugin-singlefile";

// Everything (scripts, styles) goes into dist/report.html: the binary embeds that one file.
export default defineConfig({
  plugins: [viteSingleFile({ removeViteModuleLoader: true })],
  build: {
    target: "es2021",
    outDir: "dist",
    emptyOutDir: true,
    chunkSizeWarningLimit: 4000,
    rollupOptions: { input: "report.html" },
  },
  test: { environment: "jsdom", include: ["test/**/*.test.ts"] },
});
