"use strict";
// Strips that show one moment, tables that are sorted, and pieces that are chosen.
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  const interval = 350; // ms

  for (const root of all(".strips")) {
    const slider = root.querySelector("input[type=range]");
    const play = root.querySelector(".play");
    const sheets = root.querySelector(".as-sheets");
    const said = root.querySelector("output");
    const names = all(".names li", root).map((item) => item.textContent);
    let timer = 0;

    const show = () => {
      for (const strip of all(".strip", root)) {
        const { columns, rows, count } = strip.dataset;
        const moment = Math.min(Number(slider.value), count - 1);
        const across = (-100 * (moment % columns)) / columns;
        const down = (-100 * Math.floor(moment / columns)) / rows;
        strip.firstElementChild.style.transform = `translate(${across}%, ${down}%)`;
      }
      said.textContent = names[slider.value];
      slider.setAttribute("aria-valuetext", names[slider.value]);
    };
    const stop = () => {
      clearInterval(timer);
      timer = 0;
      play.textContent = "Play";
    };
    slider.addEventListener("input", () => {
      stop();
      show();
    });
    play.addEventListener("click", () => {
      if (timer) return stop();
      timer = setInterval(() => {
        slider.value = (Number(slider.value) + 1) % names.length;
        show();
      }, interval);
      play.textContent = "Pause";
    });
    sheets.addEventListener("change", () => root.classList.toggle("sheets", sheets.checked));
  }

  // Numbers before words, and what has no value last.
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
