#!/usr/bin/python3
"""Pictures side by side in one PNG of few colours, small enough for a page: picture.py OUT.png IN.png [IN.png ...]

PNG by the standard (ISO/IEC 15948): 8-bit RGB in, 8-bit palette out. Colours by median cut (Heckbert 1982)."""
import struct
import sys
import zlib

import numpy as np


def read(path):
    data = open(path, "rb").read()
    at, compressed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            if (depth, colour, interlaced) != (8, 2, 0):
                sys.exit(f"error: {path}: expected 8-bit RGB without interlace")
        if kind == b"IDAT":
            compressed += body
        at += 12 + length
    rows = np.frombuffer(zlib.decompress(compressed), np.uint8).reshape(height, 1 + 3 * width)
    out = np.zeros((height + 1, width + 1, 3), np.int32)  # a row and a column of zeros before the first
    for y in range(height):
        kind, line = rows[y, 0], rows[y, 1:].reshape(width, 3).astype(np.int32)
        above = out[y]
        row = out[y + 1]
        if kind == 0:
            row[1:] = line
        elif kind == 2:
            row[1:] = (line + above[1:]) & 255
        else:
            for x in range(width):
                left, up, corner = row[x], above[x + 1], above[x]
                if kind == 1:
                    guess = left
                elif kind == 3:
                    guess = (left + up) // 2
                else:
                    p = left + up - corner
                    a, b, c = abs(p - left), abs(p - up), abs(p - corner)
                    guess = np.where((a <= b) & (a <= c), left, np.where(b <= c, up, corner))
                row[x + 1] = (line[x] + guess) & 255
    return out[1:, 1:].astype(np.uint8)


def median_cut(pixels, colours):
    boxes = [pixels]
    while len(boxes) < colours:
        # The box whose colours are spread over most, counted by its pixels.
        widths = [len(box) ** 0.5 * float(np.ptp(box.astype(int), axis=0).max()) for box in boxes]
        widest = int(np.argmax(widths))
        if widths[widest] == 0:
            break
        box = boxes.pop(widest)
        channel = int(np.ptp(box.astype(int), axis=0).argmax())
        box = box[np.argsort(box[:, channel], kind="stable")]
        middle = int(np.searchsorted(box[:, channel], box[len(box) // 2, channel]))
        middle = middle if 0 < middle < len(box) else len(box) // 2
        boxes += [box[:middle], box[middle:]]
    return np.array([box.mean(axis=0).round() for box in boxes], np.uint8)


def write(path, picture, colours):
    palette = median_cut(picture.reshape(-1, 3), colours)
    flat = picture.reshape(-1, 3).astype(np.int32)
    best = np.full(len(flat), np.iinfo(np.int32).max)
    index = np.zeros(len(flat), np.uint8)
    for i, colour in enumerate(palette.astype(np.int32)):
        off = ((flat - colour) ** 2).sum(axis=1)
        index[off < best] = i
        best = np.minimum(best, off)
    height, width = picture.shape[:2]
    lines = b"".join(b"\0" + row.tobytes() for row in index.reshape(height, width))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)))
        out.write(chunk(b"PLTE", palette.tobytes()) + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b""))


def beside(pictures, gap=6):
    height = max(p.shape[0] for p in pictures)
    out = np.full((height, sum(p.shape[1] + gap for p in pictures) - gap, 3), 255, np.uint8)
    x = 0
    for p in pictures:
        y = (height - p.shape[0]) // 2
        out[y : y + p.shape[0], x : x + p.shape[1]] = p
        x += p.shape[1] + gap
    return out


if __name__ == "__main__":
    import os

    picture = beside([read(path) for path in sys.argv[2:]])
    for few in (256, 128, 64, 48, 32, 24, 16):
        write(sys.argv[1], picture, few)
        if os.path.getsize(sys.argv[1]) <= 100_000:
            break
    else:
        sys.exit(f"error: {sys.argv[1]}: more than 100 kB with 16 colours; make the pictures smaller")
    print(f"{sys.argv[1]}: {picture.shape[1]} x {picture.shape[0]}, {os.path.getsize(sys.argv[1]) / 1000:.0f} kB")
