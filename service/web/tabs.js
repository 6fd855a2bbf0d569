"use strict";
// One tab and one panel for each axis or row of a page. A panel is built when it is first looked at, and all before printing.
const gyrodTabs = (() => {
  const byId = (id) => document.getElementById(id);

  /// Puts the tabs into the element `tabs` and the panels into `panels`, and chooses the first.
  /// entries: [{id, title, build(panel)}]; a tab is named tab-ID, its panel panel-ID.
  function make(entries) {
    const list = byId("tabs");
    const parts = entries.map(({ id, title, build }) => {
      const tab = document.createElement("button");
      tab.type = "button";
      tab.id = `tab-${id}`;
      tab.textContent = title;
      tab.setAttribute("role", "tab");
      tab.setAttribute("aria-controls", `panel-${id}`);
      const panel = document.createElement("div");
      panel.id = `panel-${id}`;
      panel.className = "panel";
      panel.setAttribute("role", "tabpanel");
      panel.setAttribute("aria-labelledby", tab.id);
      list.append(tab);
      byId("panels").append(panel);
      return { tab, panel, title, build };
    });

    function fill({ panel, title, build }) {
      if (panel.childElementCount > 0) return;
      const heading = document.createElement("h2");
      heading.className = "axis-name";
      heading.textContent = title;
      panel.append(heading);
      build(panel);
    }

    function choose(chosen) {
      for (const part of parts) {
        part.tab.setAttribute("aria-selected", String(part === chosen));
        part.tab.tabIndex = part === chosen ? 0 : -1;
        part.panel.hidden = part !== chosen;
      }
      fill(chosen);
    }

    for (const part of parts) part.tab.addEventListener("click", () => choose(part));
    list.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step) return;
      const at = parts.findIndex((part) => part.tab === document.activeElement);
      const next = parts[(at + step + parts.length) % parts.length];
      choose(next);
      next.tab.focus();
    });
    choose(parts[0]);
    gyrodCharts.page.beforePrint = () => parts.forEach(fill);
  }

  return { make };
})();
