"use strict";
// Lists with filters, whose entries open one at a time. The address names the open entry, so the browser can go back.
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];

  for (const root of all(".listing")) {
    const list = root.querySelector(".list");
    const entries = all(".entry", root);
    const rows = all("tbody tr", list);
    const buttons = all(".filters button", root);
    const name = root.querySelector(".filters input");

    const entryOf = (id) => {
      const target = id && document.getElementById(id);
      return target ? target.closest(".entry") : null;
    };

    function show() {
      const open = entryOf(decodeURIComponent(location.hash.slice(1)));
      list.hidden = open !== null;
      for (const entry of entries) entry.hidden = entry !== open;
      if (!open) return;
      const folded = open.querySelector("section > h2 + details");
      if (folded) folded.open = true;
      scrollTo({ top: open.getBoundingClientRect().top + scrollY });
    }

    function filter() {
      const group = buttons.find((button) => button.ariaPressed === "true").dataset.group;
      const part = name.value.trim().toLowerCase();
      for (const row of rows) {
        const link = row.querySelector("a");
        const entry = entryOf(link.hash.slice(1));
        row.hidden = (group !== "" && entry.dataset.group !== group) || !link.textContent.toLowerCase().includes(part);
      }
    }

    for (const button of buttons) {
      button.addEventListener("click", () => {
        for (const other of buttons) other.ariaPressed = String(other === button);
        filter();
      });
    }
    name.addEventListener("input", filter);
    addEventListener("hashchange", show);
    show();
  }
})();
