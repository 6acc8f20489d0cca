import "./viewer.css";
import * as THREE from "three";
import { h } from "../dom";
import { Content, type Pick } from "./content";
import { parseViewer, type ViewerDocument } from "./data";
import { Overlay } from "./overlay";
import { Panel, partRows } from "./panel";
import { directions, Stage, type Section } from "./stage";

// For scripts and tests: `window.bpmsViewer`.
interface Hook {
  counts: Content["counts"];
  pick: (x: number, y: number) => { label: string; plant: string; kind: string; instance: number } | null;
  screenOf: (point: [number, number, number]) => [number, number];
  setColour: (name: string) => void;
  cut: (section: Section | null) => void;
  look: (name: string) => void;
  project: (orthographic: boolean) => void;
  pixel: (x: number, y: number) => number[]; // as drawn: red, green, blue
  frameMs: (frames: number) => number; // mean time of a frame, drawn to its end
}
declare global {
  interface Window {
    bpmsViewer?: Hook;
  }
}

function newRenderer(): THREE.WebGLRenderer {
  // What is drawn stays in the buffer, so that saving and tests see it.
  const out = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  out.setPixelRatio(Math.min(2, window.devicePixelRatio));
  out.setClearColor("#f4f6f3");
  return out;
}

function pixel(renderer: THREE.WebGLRenderer, x: number, y: number): number[] {
  const gl = renderer.getContext();
  const ratio = renderer.getPixelRatio();
  const out = new Uint8Array(4);
  gl.readPixels(Math.floor(x * ratio), gl.drawingBufferHeight - 1 - Math.floor(y * ratio), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, out);
  return [...out.subarray(0, 3)];
}

function save(stage: Stage, title: string): void {
  stage.draw();
  stage.renderer.domElement.toBlob((blob) => {
    if (!blob) return;
    const link = h("a", { href: URL.createObjectURL(blob), download: `${title}.png` });
    link.click();
    URL.revokeObjectURL(link.href);
  });
}

function start(place: HTMLElement, data: ViewerDocument): void {
  const view = h("div", { class: "picture" });
  const content = new Content(data);
  const { instances, triangles, prototypes } = content.counts;
  const overlay = new Overlay();
  const many = (n: number, one: string): string => `${n.toLocaleString("en")} ${one}${n === 1 ? "" : "s"}`;
  let stage: Stage | null = null;
  const panel = new Panel(
    data.title,
    `${many(instances, "instance")} of ${many(prototypes, "prototype")}, ${many(triangles, "triangle")}`,
    data.colourings,
    content.hasGround(),
    data.notes,
    {
      colour: (name) => setColour(name),
      look: (name) => stage?.look(new THREE.Vector3(...(directions[name] ?? [0, -1, 0]))),
      project: (flat) => stage?.project(flat),
      cut: (section) => stage?.cut(section),
      ground: (shown) => {
        content.showGround(shown);
        stage?.changed();
      },
      save: () => stage && save(stage, data.title),
    },
  );
  place.append(view, panel.element);
  const made = newRenderer();
  view.append(made.domElement, overlay.element);
  const picture = (stage = new Stage(view, made, content));
  picture.onDraw = () => overlay.update(picture.metresPerPixel(), picture.camera);

  function setColour(name: string): void {
    const colouring = data.colourings.find((c) => c.name === name) ?? data.colourings[0];
    if (!colouring) return;
    content.colourBy(colouring);
    panel.showColouring(colouring);
    picture.draw();
  }
  function show(pick: Pick | null): void {
    const prototype = pick ? content.prototypeOf(pick.group) : undefined;
    const group = pick ? data.instances[pick.group] : undefined;
    const part = pick ? prototype?.parts[pick.part] : undefined;
    content.light(part ? pick : null);
    panel.showPart(part ?? null, pick && part && prototype && group ? partRows(part, prototype, group, pick.instance) : []);
    picture.changed();
  }
  const canvas = made.domElement;
  let pressed: [number, number] | null = null;
  canvas.addEventListener("pointerdown", (e) => (pressed = [e.clientX, e.clientY]));
  canvas.addEventListener("pointerup", (e) => {
    const still = pressed && Math.hypot(e.clientX - pressed[0], e.clientY - pressed[1]) < 4;
    if (!still || e.button !== 0) return;
    const frame = canvas.getBoundingClientRect();
    show(picture.pick(e.clientX - frame.left, e.clientY - frame.top));
  });
  document.addEventListener("keydown", (e) => {
    const name = Object.keys(directions)[Number(e.key) - 1];
    if (e.key === "Escape") show(null);
    if (name) picture.look(new THREE.Vector3(...(directions[name] ?? [0, -1, 0])));
    if (e.key !== "o") return;
    picture.project(!picture.isOrthographic());
    panel.showOrthographic(picture.isOrthographic());
  });

  setColour(data.colour);
  window.bpmsViewer = {
    counts: content.counts,
    pick: (x, y) => {
      const pick = picture.pick(x, y);
      show(pick);
      const prototype = pick ? content.prototypeOf(pick.group) : undefined;
      const part = pick ? prototype?.parts[pick.part] : undefined;
      return pick && prototype && part ? { label: part.label, plant: prototype.name, kind: part.kind, instance: pick.instance } : null;
    },
    screenOf: (point) => picture.screenOf(point),
    setColour,
    cut: (section) => {
      picture.cut(section);
      picture.draw();
    },
    look: (name) => {
      picture.look(new THREE.Vector3(...(directions[name] ?? [0, -1, 0])));
      picture.draw();
    },
    project: (flat) => {
      picture.project(flat);
      picture.draw();
    },
    pixel: (x, y) => pixel(made, x, y),
    frameMs: (frames) => {
      const begin = performance.now();
      for (let k = 0; k < frames; ++k) {
        picture.draw();
        pixel(made, 0, 0); // waits until it is drawn
      }
      return (performance.now() - begin) / frames;
    },
  };
}

const place = document.getElementById("viewer");
const text = document.getElementById("bpms-data")?.textContent ?? "";
if (place) {
  try {
    const data = parseViewer(text);
    document.title = `${data.title} - bpms view`;
    start(place, data);
  } catch (error) {
    place.append(h("p", { class: "failure" }, `The plants cannot be shown: ${error instanceof Error ? error.message : String(error)}`));
    console.error(error);
  }
}
