"use strict";
// Turns, moves and paints the shapes of a view: parallel projection, far things first.
(() => {
  const scene = JSON.parse(document.getElementById("shapes").textContent);
  const canvas = document.getElementById("picture");
  const pen = canvas.getContext("2d");
  const directions = {
    oblique: [0.52, 0.38], front: [0, 0], side: [Math.PI / 2, 0], top: [0, Math.PI / 2],
  };
  const start = scene.planar ? "top" : "oblique";
  const hidden = new Set();
  let azimuth, elevation, zoom, shift, marks = 1;

  function reset(name) {
    [azimuth, elevation] = directions[name];
    zoom = 1;
    shift = [0, 0];
  }

  // Right, up and towards the reader, of a point in base coordinates.
  function turned(p) {
    const [x, y, z] = p.map((value, i) => value - scene.middle[i]);
    const ca = Math.cos(azimuth), sa = Math.sin(azimuth);
    const ce = Math.cos(elevation), se = Math.sin(elevation);
    const right = ca * x + sa * y, away = ca * y - sa * x;
    return [right, ce * z + se * away, se * z - ce * away];
  }

  function scale() {
    const side = Math.min(canvas.clientWidth, canvas.clientHeight);
    return 0.55 * zoom * side / scene.size;
  }

  function placed(p) {
    const [right, up, near] = turned(p), k = scale();
    return [canvas.clientWidth / 2 + shift[0] + k * right,
      canvas.clientHeight / 2 + shift[1] - k * up, near];
  }

  function pointsOf(item) {
    if (item.type !== "Stroke") return [item.at];
    if (!item.at) return item.points;
    const k = marks * scene.size;
    return item.points.map((p) => p.map((value, i) => item.at[i] + k * value));
  }

  const painters = {
    Stroke(item, points) {
      pen.beginPath();
      points.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
      if (item.closed) pen.closePath();
      pen.lineWidth = item.width;
      pen.setLineDash(item.dashed ? [7, 4] : []);
      if (item.fill) {
        pen.globalAlpha = item.at ? 1 : 0.6;
        pen.fillStyle = item.fill;
        pen.fill();
        pen.globalAlpha = 1;
      }
      pen.strokeStyle = item.colour;
      pen.stroke();
    },
    Ball(item, [[x, y]]) {
      pen.beginPath();
      pen.arc(x, y, Math.max(2, item.radius * marks * scene.size * scale()), 0, 7);
      pen.setLineDash([]);
      pen.lineWidth = 1.2;
      pen.fillStyle = item.fill;
      pen.fill();
      pen.strokeStyle = item.colour;
      pen.stroke();
    },
    Head(item, [[x, y]]) {
      const far = placed(item.at.map((value, i) => value + scene.size * item.direction[i]));
      const dx = far[0] - x, dy = far[1] - y;
      const long = Math.hypot(dx, dy), full = scene.size * scale();
      if (long < 1e-6 * full) return;
      const ux = dx / long, uy = dy / long, length = 11 * (0.4 + 0.6 * long / full);
      pen.fillStyle = item.colour;
      for (let i = 0; i < item.count; i += 1) {
        const tx = x - 0.9 * i * length * ux, ty = y - 0.9 * i * length * uy;
        pen.beginPath();
        pen.moveTo(tx, ty);
        pen.lineTo(tx - length * ux - 4 * uy, ty - length * uy + 4 * ux);
        pen.lineTo(tx - length * ux + 4 * uy, ty - length * uy - 4 * ux);
        pen.fill();
      }
    },
    Label(item, [[x, y]]) {
      pen.font = "12px system-ui, sans-serif";
      pen.lineWidth = 3;
      pen.setLineDash([]);
      pen.strokeStyle = "rgba(255,255,255,0.85)";
      const below = item.group === "link names" ? 16 : -6;
      pen.strokeText(item.text, x + 6, y + below);
      pen.fillStyle = item.colour;
      pen.fillText(item.text, x + 6, y + below);
    },
  };

  // Bodies count where they are farthest: joints at their ends are painted over them.
  function nearness(item, depths) {
    if (item.type === "Label") return Infinity;
    if (item.group === "links") return Math.min(...depths) - 1e-6 * scene.size;
    return depths.reduce((sum, depth) => sum + depth, 0) / depths.length;
  }

  function paint() {
    const ratio = window.devicePixelRatio || 1;
    canvas.width = canvas.clientWidth * ratio;
    canvas.height = canvas.clientHeight * ratio;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const shown = scene.items.filter((item) => !hidden.has(item.group)).map((item) => {
      const points = pointsOf(item).map(placed);
      return { item, points, near: nearness(item, points.map((p) => p[2])) };
    });
    shown.sort((a, b) => (a.near < b.near ? -1 : a.near > b.near ? 1 : 0));
    for (const { item, points } of shown) painters[item.type](item, points);
  }

  function orbit(dx, dy) {
    azimuth -= 0.008 * dx;
    elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, elevation + 0.008 * dy));
  }

  function zoomAt(x, y, factor) {
    const cx = x - canvas.clientWidth / 2, cy = y - canvas.clientHeight / 2;
    shift = [cx - factor * (cx - shift[0]), cy - factor * (cy - shift[1])];
    zoom *= factor;
  }

  const fingers = new Map();
  const spot = (event) => [event.offsetX, event.offsetY];
  const between = ([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2,
    Math.hypot(a[0] - b[0], a[1] - b[1])];

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, spot(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) return;
    const before = fingers.get(event.pointerId), old = [...fingers.values()];
    fingers.set(event.pointerId, spot(event));
    const dx = event.offsetX - before[0], dy = event.offsetY - before[1];
    if (old.length === 2) {
      const [x, y, was] = between(old), [nx, ny, is] = between([...fingers.values()]);
      zoomAt(x, y, is / Math.max(was, 1));
      shift = [shift[0] + nx - x, shift[1] + ny - y];
    } else if (event.shiftKey || event.buttons & 6) {
      shift = [shift[0] + dx, shift[1] + dy];
    } else orbit(dx, dy);
    paint();
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
  }
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoomAt(event.offsetX, event.offsetY, Math.exp(-0.0015 * event.deltaY));
    paint();
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const steps = { ArrowLeft: [-12, 0], ArrowRight: [12, 0], ArrowUp: [0, -12], ArrowDown: [0, 12] };
    const x = canvas.clientWidth / 2, y = canvas.clientHeight / 2;
    if (event.key in steps) orbit(...steps[event.key]);
    else if (event.key === "+") zoomAt(x, y, 1.15);
    else if (event.key === "-") zoomAt(x, y, 1 / 1.15);
    else return;
    event.preventDefault();
    paint();
  });
  for (const box of document.querySelectorAll("[data-group]")) {
    const follow = () => {
      if (box.checked) hidden.delete(box.dataset.group);
      else hidden.add(box.dataset.group);
    };
    follow();
    box.addEventListener("change", () => { follow(); paint(); });
  }
  for (const button of document.querySelectorAll("[data-view]")) {
    button.addEventListener("click", () => { reset(button.dataset.view); paint(); });
  }
  const slider = document.getElementById("marks");
  slider.addEventListener("input", () => { marks = 2 ** slider.value; paint(); });
  window.addEventListener("resize", paint);
  reset(start);
  paint();
})();
