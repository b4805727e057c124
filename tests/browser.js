// Measures every frame of the window and leaves the result, as JSON in base64, for --dump-dom.
const measured = (frame) => {
  const page = frame.contentDocument;
  const view = frame.contentWindow;
  const width = frame.clientWidth;
  const named = (element) => {
    const box = element.getBoundingClientRect();
    const text = element.textContent.trim().replace(/\s+/g, " ").slice(0, 40);
    return `${element.tagName}.${element.getAttribute("class") ?? ""} ${Math.round(box.left)} to ${Math.round(box.right)}: ${text}`;
  };
  const scrolled = (element) => {
    for (let at = element.parentElement; at && at !== page.body; at = at.parentElement) {
      if (["auto", "scroll", "hidden"].includes(view.getComputedStyle(at).overflowX)) return true;
    }
    return false;
  };
  const shown = [...page.body.querySelectorAll("*")].filter((element) => {
    const box = element.getBoundingClientRect();
    return (box.width || box.height) && !element.parentElement.closest("svg");
  });
  const beyond = (element) => {
    const box = element.getBoundingClientRect();
    return box.right > width + 1 || box.left < -1;
  };
  const drawings = [...page.querySelectorAll("svg[data-axes]")].filter((svg) => svg.checkVisibility());
  const hovered = drawings.map((svg) => {
    const curve = svg.querySelector("[data-curve]");
    if (!curve) return "";
    const box = curve.getBoundingClientRect();
    const place = { clientX: box.left + box.width / 2, clientY: box.top + box.height / 2, bubbles: true };
    svg.dispatchEvent(new view.PointerEvent("pointermove", place));
    const tip = page.querySelector(".tip");
    return tip.hidden ? "" : tip.textContent;
  });
  const texts = drawings.map((svg) => ({
    edge: svg.getBoundingClientRect(),
    labels: [...svg.querySelectorAll("text")].filter((text) => text.textContent.trim()).map((text) => ({ text, box: text.getBoundingClientRect() })),
  }));
  const clipped = texts.flatMap(({ edge, labels }) => labels.filter(({ box }) =>
    box.left < edge.left - 2 || box.right > edge.right + 2 || box.top < edge.top - 2 || box.bottom > edge.bottom + 2));
  // A box holds room above and below the letters: two lines of text may share a fifth of it.
  const common = (one, other) => Math.max(0, Math.min(one.right, other.right) - Math.max(one.left, other.left))
    * Math.max(0, Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top));
  const area = (box) => box.width * box.height;
  const overlapping = texts.flatMap(({ labels }) => labels.flatMap((one, at) => labels.slice(at + 1)
    .filter((other) => common(one.box, other.box) > 0.25 * Math.min(area(one.box), area(other.box)))
    .map((other) => `${one.text.textContent} | ${other.text.textContent}`)));
  return {
    name: frame.dataset.name,
    width,
    scroll_width: page.documentElement.scrollWidth,
    outside: shown.filter((element) => beyond(element) && !scrolled(element)).map(named),
    cut: shown.filter((element) => scrolled(element) === false && element.scrollWidth > element.clientWidth + 1
      && ["auto", "scroll", "hidden"].includes(view.getComputedStyle(element).overflowX)).map(named),
    empty: drawings.filter((svg) => !svg.getBoundingClientRect().width || !svg.getBoundingClientRect().height).map(named),
    clipped: clipped.map(({ text }) => named(text)),
    overlapping,
    hovered,
  };
};
addEventListener("load", () => {
  const told = new TextEncoder().encode(JSON.stringify([...document.querySelectorAll("iframe")].map(measured)));
  document.body.textContent = `@@${btoa(Array.from(told, (byte) => String.fromCharCode(byte)).join(""))}@@`;
});
