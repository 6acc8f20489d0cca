// A PNG of a viewer's page after some of its calls: node scripts/look.mjs page.html out.png ["setColour('length')" ...]
import { openPage } from "./browser.mjs";

const [file, out, ...calls] = process.argv.slice(2);
if (!file || !out) {
  console.error("usage: node scripts/look.mjs page.html out.png [CALL_OF_BPMSVIEWER ...]");
  process.exit(2);
}
const page = await openPage(file);
for (const call of calls) await page.evaluate(`void window.bpmsViewer.${call}`);
await page.evaluate("window.bpmsViewer.frameMs(1)");
await page.screenshot(out);
for (const words of page.complaints) console.error(words);
await page.close();
process.exit(page.complaints.length > 0 ? 1 : 0);
