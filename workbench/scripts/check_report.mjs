// Whether a report page draws what it holds: node scripts/check_report.mjs page.html FIGURE_ID ...
// Every figure named must be there, every chart and scene on the page drawn, the console silent.
import { openPage } from "./browser.mjs";

const [file, ...wanted] = process.argv.slice(2);
if (!file) {
  console.error("usage: node scripts/check_report.mjs page.html [FIGURE_ID ...]");
  process.exit(2);
}
const page = await openPage(file, { width: 1200, height: 900 });
const seen = await page.evaluate(`(async () => {
  await new Promise((done) => setTimeout(done, 200));
  return [...document.querySelectorAll("figure")].map((f) => ({
    id: f.id,
    drawn: f.querySelector(".plot") ? f.querySelector(".plot svg.main-svg") !== null : f.querySelector(".scene") ? f.querySelector(".scene canvas") !== null : true,
  }));
})()`);
const failures = [
  ...wanted.filter((id) => !seen.some((f) => f.id === id)).map((id) => `no figure ${id}`),
  ...seen.filter((f) => !f.drawn).map((f) => `${f.id} is not drawn`),
  ...(await page.evaluate('[...document.querySelectorAll("p.absent")].map((e) => e.textContent)')),
  ...page.complaints.map((c) => `console: ${c}`),
];
await page.close();
for (const failure of failures) console.error(failure);
process.exit(failures.length > 0 ? 1 : 0);
