// Cuts the white rows at the foot of an 8-bit RGB(A) PNG, in place, leaving a margin.
import { readFileSync, writeFileSync } from "node:fs";
import { deflateSync, inflateSync } from "node:zlib";

const table = Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n >>> 0;
});

export function crc32(bytes) {
  let c = 0xffffffff;
  for (const b of bytes) c = table[(c ^ b) & 255] ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}

export function chunk(type, body) {
  const out = Buffer.alloc(12 + body.length);
  out.writeUInt32BE(body.length, 0);
  out.write(type, 4, "latin1");
  body.copy(out, 8);
  out.writeUInt32BE(crc32(out.subarray(4, 8 + body.length)), 8 + body.length);
  return out;
}

export const signature = Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]);

function chunks(file) {
  const found = [];
  for (let at = 8; at < file.length; at += 12 + file.readUInt32BE(at))
    found.push({ type: file.toString("latin1", at + 4, at + 8), body: file.subarray(at + 8, at + 8 + file.readUInt32BE(at)) });
  return found;
}

function unfilter(data, stride, bytes) {
  const rows = data.length / (stride + 1);
  const out = Buffer.alloc(rows * stride);
  for (let y = 0; y < rows; ++y) {
    const filter = data[y * (stride + 1)];
    for (let i = 0; i < stride; ++i) {
      const a = i >= bytes ? out[y * stride + i - bytes] : 0;
      const b = y > 0 ? out[(y - 1) * stride + i] : 0;
      const c = i >= bytes && y > 0 ? out[(y - 1) * stride + i - bytes] : 0;
      const pa = Math.abs(b - c), pb = Math.abs(a - c), pc = Math.abs(a + b - 2 * c); // prettier-ignore
      const paeth = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
      const guess = [0, a, b, (a + b) >> 1, paeth][filter];
      out[y * stride + i] = (data[y * (stride + 1) + 1 + i] + guess) & 255;
    }
  }
  return out;
}

export function trimPng(path, margin) {
  const parts = chunks(readFileSync(path));
  const head = Buffer.from(parts[0].body);
  const [width, height, depth, kind] = [head.readUInt32BE(0), head.readUInt32BE(4), head[8], head[9]];
  if (depth !== 8 || (kind !== 2 && kind !== 6) || head[12] !== 0) return;
  const bytes = kind === 6 ? 4 : 3;
  const stride = width * bytes;
  const pixels = unfilter(inflateSync(Buffer.concat(parts.filter((p) => p.type === "IDAT").map((p) => p.body))), stride, bytes);
  let last = height - 1;
  while (last > 0 && pixels.subarray(last * stride, (last + 1) * stride).every((v) => v === 255)) --last;
  const rows = Math.min(height, last + 1 + margin);
  head.writeUInt32BE(rows, 4);
  const raw = Buffer.alloc(rows * (stride + 1));
  for (let y = 0; y < rows; ++y) {
    raw[y * (stride + 1)] = y === 0 ? 0 : 2; // filter "up"
    for (let i = 0; i < stride; ++i) {
      const above = y > 0 ? pixels[(y - 1) * stride + i] : 0;
      raw[y * (stride + 1) + 1 + i] = (pixels[y * stride + i] - above) & 255;
    }
  }
  const others = parts.filter((p) => !["IHDR", "IDAT", "IEND"].includes(p.type)).map((p) => chunk(p.type, p.body));
  const body = chunk("IDAT", deflateSync(raw, { level: 9 }));
  writeFileSync(path, Buffer.concat([signature, chunk("IHDR", head), ...others, body, chunk("IEND", Buffer.alloc(0))]));
}
