// Pictures for the sample: an 8-bit RGB PNG of a function of the pixel, as a data URI.
import { deflateSync } from "node:zlib";
import { chunk, signature } from "../trim_png.mjs";

export function pngUri(width, height, pixel) {
  const raw = Buffer.alloc(height * (3 * width + 1));
  for (let y = 0; y < height; ++y) {
    const row = y * (3 * width + 1);
    for (let x = 0; x < width; ++x) Buffer.from(pixel(x, y).map((v) => Math.max(0, Math.min(255, Math.round(v))))).copy(raw, row + 1 + 3 * x);
  }
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 2, 0, 0, 0], 8);
  const file = Buffer.concat([signature, chunk("IHDR", head), chunk("IDAT", deflateSync(raw, { level: 9 })), chunk("IEND", Buffer.alloc(0))]);
  return `data:image/png;base64,${file.toString("base64")}`;
}
