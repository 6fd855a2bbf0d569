"use strict";
// What gyrod's pages are put together from: elements, tables and figures. Text becomes text, never markup, wherever it came from.
const gyrodParts = (() => {
  const { chart, tools, keyboard, number } = gyrodCharts;

  function element(tag, text, className) {
    const made = document.createElement(tag);
    if (text !== undefined) made.textContent = text;
    if (className) made.className = className;
    return made;
  }

  /// Says in a figure's or table's place why it is not there.
  function absent(parent, what, reason) {
    parent.append(element("p", `${what} cannot be shown: ${reason}`, "absent"));
  }

  function swatch(colour) {
    const made = element("span", undefined, "swatch");
    made.style.background = `var(${colour})`;
    return made;
  }

  function fill(place, cell, className) {
    place.className = className;
    if (cell instanceof Node) {
      place.append(cell);
    } else if (cell !== null && typeof cell === "object") {
      if (cell.colour) place.append(swatch(cell.colour));
      place.append(element("span", cell.text, cell.className));
    } else {
      place.append(typeof cell === "string" ? cell : number(cell));
    }
  }

  /// rows: [{cells, strong}]; a cell is text, a number, a node, or {text, className, colour}. Columns of words: their numbers in `words`.
  /// Those in `long` may break into lines, most of all the first of them.
  function table(parent, caption, heads, rows, words = [0], long = []) {
    const box = element("div", undefined, "scroll");
    box.tabIndex = 0;
    box.setAttribute("role", "region");
    box.setAttribute("aria-label", caption);
    const made = element("table", undefined, "numbers");
    made.append(element("caption", caption));
    const head = made.createTHead().insertRow();
    heads.forEach((text, i) => {
      const cell = element("th", text, words.includes(i) ? "text" : undefined);
      cell.scope = "col";
      head.append(cell);
    });
    const body = made.createTBody();
    const classOf = (i) => (long.length > 1 && i === long[0] ? "text longest" : long.includes(i) ? "text long" : words.includes(i) ? "text" : "");
    for (const { cells, strong } of rows) {
      const row = body.insertRow();
      if (strong) row.className = "strong";
      cells.forEach((cell, i) => fill(row.insertCell(), cell, classOf(i)));
    }
    box.append(made);
    parent.append(box);
    return box;
  }

  /// A figure with caption and room for its plot. @return {figure, caption, plot, finish(charts)}
  function frame(parent, title, note, className = "single") {
    const figure = element("figure", undefined, className);
    const caption = element("figcaption");
    caption.append(element("span", title, "title"));
    const plot = element("div", undefined, "plot");
    figure.append(caption, plot);
    if (note) figure.append(element("p", note, "note"));
    parent.append(figure);
    const finish = (charts) => {
      caption.append(tools(charts, title));
      plot.setAttribute("role", "group");
      plot.setAttribute("aria-label", `${title}. Keys: plus and minus zoom, arrows move, 0 shows all.`);
      keyboard(plot, charts);
    };
    return { figure, caption, plot, finish };
  }

  /// A figure with one chart. @return the chart
  function single(parent, title, note, spec) {
    const { plot, finish } = frame(parent, title, note);
    const made = chart(plot, { height: 280, label: title, ...spec });
    finish([made]);
    return made;
  }

  return { element, absent, swatch, table, frame, single };
})();
