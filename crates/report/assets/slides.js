// Turns slides: by arrow keys, space and page keys, by buttons, by a swipe; `#3.2` is the second step of the third slide.
(() => {
  const slides = [...document.querySelectorAll(".slide")];
  const paced = document.querySelector("main").dataset.pace === "steps";
  const turning = document.querySelector(".turning");
  const stepsOf = (k) => [...slides[k].querySelectorAll(".step")];
  const last = (k) => (paced ? Math.max(0, stepsOf(k).length - 1) : 0);
  let at = [0, 0];

  // What is too tall is set smaller.
  const fit = () => {
    const body = slides[at[0]].querySelector(".body");
    if (!body) return;
    let share = 1;
    const set = () => body.style.setProperty("--share", share);
    set();
    while (share > 0.4 && (body.scrollHeight > body.clientHeight + 1 || wide(body))) {
      share -= 0.04;
      set();
    }
  };
  const wide = (body) => [...body.querySelectorAll(".formula, .table")].some((one) => one.scrollWidth > one.clientWidth + 1);

  const show = (slide, step) => {
    const before = at[0];
    at = [slide, step];
    slides.forEach((one, k) => {
      one.classList.toggle("shown", k === slide);
      one.setAttribute("aria-hidden", String(k !== slide));
    });
    stepsOf(slide).forEach((one, k) => one.classList.toggle("waits", paced && k > step));
    turning.querySelector(".place").textContent = `${slide + 1} / ${slides.length}`;
    turning.querySelector(".before").disabled = slide === 0 && step === 0;
    turning.querySelector(".next").disabled = slide === slides.length - 1 && step === last(slide);
    history.replaceState(null, "", `#${slide + 1}.${step + 1}`);
    fit();
    if (before !== slide) slides[slide].querySelector(".body")?.scrollTo(0, 0);
  };
  const next = () => {
    const [slide, step] = at;
    if (step < last(slide)) show(slide, step + 1);
    else if (slide + 1 < slides.length) show(slide + 1, 0);
  };
  const back = () => {
    const [slide, step] = at;
    if (step > 0) show(slide, step - 1);
    else if (slide > 0) show(slide - 1, last(slide - 1));
  };
  const asked = () => {
    const [slide, step] = location.hash.slice(1).split(".").map((x) => Number.parseInt(x, 10) - 1);
    const k = Number.isInteger(slide) ? Math.min(Math.max(slide, 0), slides.length - 1) : 0;
    return [k, Number.isInteger(step) ? Math.min(Math.max(step, 0), last(k)) : 0];
  };

  const keys = {
    ArrowRight: next, ArrowDown: next, PageDown: next, " ": next, Enter: next,
    ArrowLeft: back, ArrowUp: back, PageUp: back, Backspace: back,
    Home: () => show(0, 0),
    End: () => show(slides.length - 1, last(slides.length - 1)),
    f: () => (document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen?.()),
  };
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    // A button that has the focus is pressed by these.
    if ((event.key === " " || event.key === "Enter") && event.target.closest("button")) return;
    const act = event.shiftKey && event.key === " " ? back : keys[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
  turning.querySelector(".next").addEventListener("click", next);
  turning.querySelector(".before").addEventListener("click", back);
  let from = null;
  addEventListener("touchstart", (event) => (from = event.touches.length === 1 ? event.touches[0].clientX : null), { passive: true });
  addEventListener("touchend", (event) => {
    const by = from === null ? 0 : event.changedTouches[0].clientX - from;
    if (Math.abs(by) > 50) (by < 0 ? next : back)();
  });
  addEventListener("hashchange", () => show(...asked()));
  addEventListener("resize", fit);
  document.documentElement.classList.add("turned");
  turning.hidden = false;
  show(...asked());
})();
