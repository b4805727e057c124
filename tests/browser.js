const LEAST_CONTRAST = 4.5;  // of text, by the Web Content Accessibility Guidelines 2.1 (AA)
// Measures every frame of the window and leaves the result, as JSON in base64, for --dump-dom.
const canvas = Object.assign(document.createElement("canvas"), { width: 1, height: 1 }).getContext("2d", { willReadFrequently: true });
const channels = new Map();
const rgba = (colour) => {  // of any colour that CSS can name
  if (!channels.has(colour)) {
    canvas.clearRect(0, 0, 1, 1);
    canvas.fillStyle = colour;
    canvas.fillRect(0, 0, 1, 1);
    const [red, green, blue, alpha] = canvas.getImageData(0, 0, 1, 1).data;
    channels.set(colour, [red, green, blue, alpha / 255]);
  }
  return channels.get(colour);
};
const over = ([red, green, blue, alpha], below, opacity = 1) =>
  [red, green, blue].map((one, at) => alpha * opacity * one + (1 - alpha * opacity) * below[at]);
const luminance = (colour) => {
  const [red, green, blue] = colour.map((one) => (one <= 10.3 ? one / 3294.6 : ((one / 255 + 0.055) / 1.055) ** 2.4));
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
};
const contrast = (one, other) => {
  const [dim, bright] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (bright + 0.05) / (dim + 0.05);
};
// The contrast of every text against the backgrounds and, in a drawing, the shapes that lie behind it.
const contrasts = (page, view) => {
  const walker = page.createTreeWalker(page.body, view.NodeFilter.SHOW_TEXT);
  const holders = new Set();
  while (walker.nextNode()) if (walker.currentNode.data.trim()) holders.add(walker.currentNode.parentElement);
  const found = [];
  for (const holder of holders) {
    if (["SCRIPT", "STYLE", "title", "TITLE"].includes(holder.tagName) || !holder.checkVisibility({ visibilityProperty: true })) continue;
    const styles = [];
    for (let at = holder; at; at = at.parentElement) styles.unshift(view.getComputedStyle(at));
    let behind = [255, 255, 255];
    let opacity = 1;
    for (const style of styles) {
      behind = over(rgba(style.backgroundColor), behind, opacity);
      opacity *= Number(style.opacity);
    }
    const own = styles.at(-1);
    const drawing = holder.closest("svg");
    if (drawing) {
      holder.scrollIntoView({ block: "center", inline: "center" });
      const box = holder.getBoundingClientRect();
      const at = page.elementsFromPoint(box.left + box.width / 2, box.top + box.height / 2);
      const shapes = at.filter((shape) => shape.ownerSVGElement === drawing && ["path", "rect"].includes(shape.tagName));
      for (const shape of shapes.reverse()) {
        const painted = shape.compareDocumentPosition(holder) & view.Node.DOCUMENT_POSITION_FOLLOWING;
        const style = view.getComputedStyle(shape);
        if (painted && style.fill !== "none") behind = over(rgba(style.fill), behind, Number(style.fillOpacity) * Number(style.opacity));
      }
    }
    const ink = over(rgba(drawing ? own.fill : own.color), behind, opacity);
    found.push([contrast(ink, behind), holder]);
  }
  return found;
};
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
    const aim = svg.querySelector("[data-curve]") ?? svg.querySelector("image");  // a curve, or the pixels of a map
    if (!aim) return "";
    const box = aim.getBoundingClientRect();
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
    faint: contrasts(page, view).filter(([ratio]) => ratio < LEAST_CONTRAST).map(([ratio, text]) => `${ratio.toFixed(1)} ${named(text)}`),
    hovered,
  };
};
addEventListener("load", () => {
  const told = new TextEncoder().encode(JSON.stringify([...document.querySelectorAll("iframe")].map(measured)));
  document.body.textContent = `@@${btoa(Array.from(told, (byte) => String.fromCharCode(byte)).join(""))}@@`;
});
