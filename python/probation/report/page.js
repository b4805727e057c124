// Shows the values that the pointer stands on in a plot. Curves are read from the drawing itself.
(() => {
  const tip = document.createElement("div");
  tip.className = "tip";
  tip.hidden = true;
  document.body.append(tip);

  const value = (axis, at) => {
    const [first, last, low, high] = axis.ends;
    const part = (at - first) / (last - first);
    return axis.log ? low * (high / low) ** part : low + part * (high - low);
  };
  const inside = (axis, at) => !axis || (at - axis.ends[0]) * (at - axis.ends[1]) <= 0;
  const told = (axis, at) => {
    const [, name, unit] = axis.label.match(/^(.*?)(?: \[(.*)\])?$/s);
    const number = String(+value(axis, at).toPrecision(4)).replace("-", "\u2212");
    return `${name ? name + " " : ""}${number}${unit && unit !== "\u2013" ? " " + unit : ""}`;
  };

  // The points of a curve: corners of its path, or the places of its dots.
  const points = (group) => {
    if (!group.points) {
      const dots = [...group.querySelectorAll("use")].map((dot) => [+dot.getAttribute("x"), +dot.getAttribute("y")]);
      const paths = [...group.querySelectorAll(":scope > path")].map((path) => path.getAttribute("d")).join(" ");
      const corners = [...paths.matchAll(/[ML] (\S+) (\S+)/g)].map((corner) => [+corner[1], +corner[2]]);
      group.points = { line: dots.length === 0, places: dots.length ? dots : corners };
    }
    return group.points;
  };
  // The place of a curve next to the pointer: on a line at the same x, else the nearest dot.
  const nearest = (group, x, y) => {
    const { line, places } = points(group);
    let best = null;
    const offer = (px, py, far) => { if (!best || far < best.far) best = { x: px, y: py, far }; };
    places.forEach(([px, py], at) => {
      const [qx, qy] = places[at + 1] ?? [px, py];
      if (line && px !== qx && (x - px) * (x - qx) <= 0) {
        const on = py + ((x - px) / (qx - px)) * (qy - py);
        offer(x, on, Math.abs(on - y));
      } else {
        offer(px, py, Math.hypot(px - x, py - y));
      }
    });
    return best;
  };

  // The value of the pixel of a map, and its unit from the bar beside the map.
  const pixel = (map, x, y) => {
    const within = (borders, at) => borders.findIndex((border, of) => of && (at - borders[of - 1]) * (at - border) <= 0) - 1;
    const told = map.values[within(map.y, y)]?.[within(map.x, x)];
    return `${map.label} ${told === undefined || told === null ? "\u2013" : String(told).replace("-", "\u2212") + map.unit}`;
  };

  const show = (event) => {
    const svg = event.currentTarget;
    const matrix = svg.getScreenCTM();
    if (!matrix) return;
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    const all = (svg.axes ??= JSON.parse(svg.dataset.axes));
    const at = all.findIndex((axes) => (axes.x || axes.y) && inside(axes.x, x) && inside(axes.y, y));
    tip.hidden = at < 0;
    if (at < 0) return;
    let place = { x, y, far: 15 };
    let name = "";
    all[at].curves.forEach((label, of) => {
      for (const group of svg.querySelectorAll(`[data-curve="${at}-${of}"]`)) {
        const found = nearest(group, x, y);
        if (found && found.far < place.far) [place, name] = [found, label];
      }
    });
    const values = [["x", place.x], ["y", place.y]].filter(([axis]) => all[at][axis]);
    if (all[at].map) name = pixel(all[at].map, value(all[at].x, x), value(all[at].y, y));
    tip.textContent = [name, ...values.map(([axis, where]) => told(all[at][axis], where))].filter(Boolean).join("\n");
    const box = tip.getBoundingClientRect();
    tip.style.left = `${Math.max(4, Math.min(event.clientX + 14, innerWidth - box.width - 4))}px`;
    tip.style.top = `${event.clientY + 18 + box.height > innerHeight ? event.clientY - box.height - 10 : event.clientY + 18}px`;
  };

  for (const svg of document.querySelectorAll("svg[data-axes]")) {
    svg.addEventListener("pointermove", show);
    svg.addEventListener("pointerdown", show);
    svg.addEventListener("pointerleave", () => { tip.hidden = true; });
  }
})();
