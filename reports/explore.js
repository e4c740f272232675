"use strict";
// Sortable tables, and pieces selected by lists.
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  // Numbers before words, empty cells last.
  const rank = (text) => (text === "" || text === "–" ? 2 : Number.isNaN(Number(text)) ? 1 : 0);
  const compare = (a, b) =>
    rank(a) - rank(b) || (rank(a) === 0 ? Number(a) - Number(b) : a.localeCompare(b, undefined, { numeric: true }));

  for (const table of all(".sortable table")) {
    const body = table.tBodies[0];
    const heads = all("thead th", table);
    heads.forEach((head, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener("click", () => {
        const direction = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
        for (const other of heads) other.removeAttribute("aria-sort");
        head.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
        const text = (row) => row.cells[column].textContent.trim();
        const sorted = [...body.rows].sort((a, b) => {
          const order = compare(text(a), text(b));
          return rank(text(a)) === 2 || rank(text(b)) === 2 ? order : direction * order;
        });
        body.append(...sorted);
      });
    });
  }

  for (const root of all(".chooser")) {
    const lists = all("select", root);
    const show = () => {
      const chosen = lists.map((list) => list.value).join(" ");
      for (const piece of all(".choice", root)) piece.hidden = piece.dataset.chosen !== chosen;
    };
    for (const list of lists) list.addEventListener("change", show);
    show();
  }
})();
