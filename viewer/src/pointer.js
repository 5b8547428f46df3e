// Mouse, pen and fingers on the picture: orbit, pan, zoom, click.

const STILL = 4; // pixels that a click may wander
const ORBIT = 0.0075; // radians for each pixel

/** `clicked(x, y)` and `doubled(x, y)` get pixels of the window; `area` gives the part of the window with the picture under a
 *  pixel. */
export function listen(canvas, camera, { clicked, doubled, area = () => canvas.getBoundingClientRect() }) {
  const down = new Map();
  let wandered = 0;
  let spread = 0;

  const ndc = (x, y) => {
    const box = area(x);
    return [((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2];
  };

  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    down.set(event.pointerId, event);
    if (down.size === 1) wandered = 0;
    else wandered = Infinity;
    spread = 0;
  });

  canvas.addEventListener('pointermove', (event) => {
    const last = down.get(event.pointerId);
    if (!last) return;
    const [dx, dy] = [event.clientX - last.clientX, event.clientY - last.clientY];
    wandered += Math.abs(dx) + Math.abs(dy);
    down.set(event.pointerId, event);
    if (wandered < STILL) return;
    canvas.classList.add('held');
    const height = canvas.clientHeight;
    if (down.size === 2) {
      const [a, b] = [...down.values()];
      const wide = Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
      const middle = ndc((a.clientX + b.clientX) / 2, (a.clientY + b.clientY) / 2);
      if (spread > 0 && wide > 0) camera.zoom(spread / wide, ...middle);
      spread = wide;
      camera.pan(-dx / 2 / height, dy / 2 / height);
    } else if (event.buttons & 6 || event.shiftKey || event.metaKey) camera.pan(-dx / height, dy / height);
    else if (event.ctrlKey) camera.zoom(Math.exp(dy * 0.006));
    else camera.rotate(dx * ORBIT, dy * ORBIT);
  });

  const release = (event) => {
    const first = down.get(event.pointerId);
    down.delete(event.pointerId);
    spread = 0;
    if (down.size === 0) canvas.classList.remove('held');
    if (first && event.type === 'pointerup' && event.button === 0 && wandered < STILL)
      clicked(event.clientX, event.clientY);
  };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', release);
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('dblclick', (event) => doubled(event.clientX, event.clientY));

  canvas.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      const speed = event.ctrlKey ? 0.01 : 0.0016;
      const turn = Math.min(Math.max(event.deltaY * lines, -240), 240);
      camera.zoom(Math.exp(turn * speed), ...ndc(event.clientX, event.clientY));
    },
    { passive: false },
  );
}
