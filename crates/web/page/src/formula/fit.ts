// Formulas that are a little too wide for their box are set a little smaller; those that are much too wide keep their size and scroll.

/** As small as this, of the usual size: smaller ones are hard to read. */
const SMALLEST = 0.8;

function fit(root: Element): void {
  const all = [...root.querySelectorAll<HTMLElement>(".formula-box")].map((box) => ({ box, math: box.querySelector<HTMLElement>("math") }));
  for (const { math } of all) math?.style.removeProperty("font-size");
  // All is read before anything is written.
  const sizes = all.map(({ box, math }) => {
    const { paddingLeft, paddingRight } = getComputedStyle(box);
    const room = box.clientWidth - parseFloat(paddingLeft) - parseFloat(paddingRight);
    const width = math?.getBoundingClientRect().width ?? 0;
    return math && width > room && room >= SMALLEST * width ? parseFloat(getComputedStyle(math).fontSize) * (room / width) : 0;
  });
  all.forEach(({ math }, k) => {
    if (sizes[k] > 0) math?.style.setProperty("font-size", `${Math.floor(10 * sizes[k]) / 10}px`);
  });
}

/** Keeps the formulas of a document so, whatever becomes of its width, until what it returns is called. */
export function keepFitted(root: Element): () => void {
  let width = -1;
  const again = () => {
    if (root.clientWidth === width) return;
    width = root.clientWidth;
    fit(root);
  };
  const watcher = new ResizeObserver(again);
  watcher.observe(root);
  again();
  let ended = false;
  // The letters may come later than the formulas.
  void document.fonts.ready.then(() => {
    if (!ended) fit(root);
  });
  return () => {
    ended = true;
    watcher.disconnect();
  };
}
