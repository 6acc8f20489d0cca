import { defineConfig } from "vitest/config";
import { readFileSync } from "node:fs";
import type { Plugin } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

const largest = 3_500_000; // bytes: the template is part of the binary

// The template is worth nothing if the token is not there once, or if it asks for another file.
function checkTemplate(name: string): Plugin {
  return {
    name: "check-template",
    apply: "build",
    writeBundle(options) {
      const page = readFileSync(`${options.dir ?? "dist"}/${name}`, "utf8");
      const tokens = page.split("__BPMS_DATA__").length - 1;
      if (tokens !== 1) this.error(`the template holds the data token ${tokens} times instead of once`);
      if (/<(script|link)[^>]*(src|href)="(?!data:)/.test(page)) this.error("the template asks for another file");
      if (page.length > largest) this.error(`the template has ${page.length} bytes, more than ${largest}`);
    },
  };
}

// Everything (scripts, styles) goes into dist/report.html, or with --mode viewer into dist/viewer.html: the binary embeds
// these files.
export default defineConfig(({ mode }) => ({
  plugins: [viteSingleFile({ removeViteModuleLoader: true }), checkTemplate(mode === "viewer" ? "viewer.html" : "report.html")],
  build: {
    target: "es2021",
    outDir: "dist",
    emptyOutDir: mode !== "viewer",
    chunkSizeWarningLimit: 4000,
    rollupOptions: { input: mode === "viewer" ? "viewer.html" : "report.html" },
  },
  test: { environment: "jsdom", include: ["test/**/*.test.ts"] },
}));
