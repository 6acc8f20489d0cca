// Looks into a viewer's page in headless Chromium and compares with what must be there:
//   node scripts/check_viewer.mjs page.html facts.json [picture.png]
// facts: { counts, points: [{ at, label, plant, kind, parameter }], cut: { section, hidden, shown }, colours: [{ by, at, brightest }] }
// Views are from above, orthographic. Ends with 1 and a line for each thing that is not so.
import { readFileSync } from "node:fs";
import { openPage } from "./browser.mjs";

const [file, factsFile, picture] = process.argv.slice(2);
if (!file || !factsFile) {
  console.error("usage: node scripts/check_viewer.mjs page.html facts.json [picture.png]");
  process.exit(2);
}
const facts = JSON.parse(readFileSync(factsFile, "utf8"));
const failures = [];
function expectSame(what, found, expected) {
  if (JSON.stringify(found) !== JSON.stringify(expected)) failures.push(`${what}: ${JSON.stringify(found)}, expected ${JSON.stringify(expected)}`);
}

const page = await openPage(file);
const ask = (call) => page.evaluate(`window.bpmsViewer.${call}`);
const screen = (at) => ask(`screenOf(${JSON.stringify(at)})`);
const background = [244, 246, 243];
await ask('look("top")');
await ask("project(true)");

const counts = await ask("counts");
for (const [name, count] of Object.entries(facts.counts ?? {})) expectSame(name, counts[name], count);

for (const { at, label, plant, kind, parameter } of facts.points ?? []) {
  const [x, y] = await screen(at);
  const found = await ask(`pick(${x}, ${y})`);
  expectSame(`picked at ${at}`, found && { label: found.label, plant: found.plant, kind: found.kind }, { label, plant, kind });
  await ask("pick(1, 1)");
  await page.click(x, y);
  const words = await page.evaluate('document.querySelector(".organ").textContent');
  for (const word of [label, plant, parameter]) if (word && !words.includes(word)) failures.push(`clicked at ${at}: no '${word}' in '${words}'`);
  await ask("pick(1, 1)");
}

// The brightest channel of a colouring at a place: 0 red, 1 green, 2 blue.
for (const { by, at, order } of facts.colours ?? []) {
  await ask(`setColour(${JSON.stringify(by)})`);
  const [x, y] = await screen(at);
  const seen = await ask(`pixel(${x}, ${y})`);
  const found = [0, 1, 2].sort((a, b) => seen[b] - seen[a]);
  expectSame(`order of red, green, blue by ${by} at ${at} in ${seen}`, found, order);
  expectSame("the legend's title", await page.evaluate('document.getElementById("colour").value'), by);
}

if (facts.cut) {
  const { section, hidden, shown } = facts.cut;
  const seen = async (at) => {
    const [x, y] = await screen(at);
    return { pixel: await ask(`pixel(${x}, ${y})`), pick: await ask(`pick(${x}, ${y})`) };
  };
  await ask(`cut(${JSON.stringify(section)})`);
  const gone = await seen(hidden);
  expectSame("behind the section: pixel", gone.pixel, background);
  expectSame("behind the section: picked", gone.pick, null);
  if ((await seen(shown)).pick === null) failures.push("before the section nothing is picked");
  await ask("cut(null)");
  if ((await seen(hidden)).pick === null) failures.push("without the section nothing is picked");
}
if (picture) await page.screenshot(picture);
console.log(`frame ${(await ask("frameMs(3)")).toFixed(1)} ms, ${counts.triangles} triangles, software GL`);
expectSame("console", page.complaints, []);
await page.close();
for (const failure of failures) console.error(failure);
process.exit(failures.length > 0 ? 1 : 0);
