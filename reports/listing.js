"use strict";
// Lists with filters, whose entries open one at a time. The address names the open entry, so the browser can go back.
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];

  for (const root of all(".listing")) {
    const list = root.querySelector(".list");
    const entries = all(".entry", root);
    const rows = all("tbody tr", list);
    const buttons = all(".filters button", root);
    const field = root.querySelector(".filters input");

    const entryOf = (id) => {
      const target = id && document.getElementById(id);
      return target ? target.closest(".entry") : null;
    };

    function show() {
      const open = entryOf(decodeURIComponent(location.hash.slice(1)));
      list.hidden = open !== null;
      for (const entry of entries) entry.hidden = entry !== open;
      if (!open) return;
      const folded = open.querySelector("section > :is(h2, h3) + details");
      if (folded) folded.open = true;
      scrollTo({ top: open.getBoundingClientRect().top + scrollY });
    }

    function filter() {
      const group = buttons.find((button) => button.ariaPressed === "true").dataset.group;
      const words = field.value.toLowerCase().split(" ").filter(Boolean);
      for (const row of rows) {
        const entry = entryOf(row.querySelector("a").hash.slice(1));
        const text = row.textContent.toLowerCase();
        row.hidden = (group !== "" && entry.dataset.group !== group) || !words.every((word) => text.includes(word));
      }
    }

    for (const button of buttons) {
      button.addEventListener("click", () => {
        for (const other of buttons) other.ariaPressed = String(other === button);
        filter();
      });
    }
    field.addEventListener("input", filter);
    addEventListener("hashchange", show);
    show();
  }
})();
