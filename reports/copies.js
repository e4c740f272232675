"use strict";
// Copies tables for spreadsheets, Markdown and LaTeX, and diagrams as pictures.
(() => {
  const cells = (table) => [...table.rows].map((row) => [...row.cells].map((cell) => cell.textContent.trim()));
  const numeric = (table) => [...table.rows[0].cells].map((cell) => cell.classList.contains("number"));

  const forms = {
    CSV: (table) => {
      // A spreadsheet would treat such a text as a formula.
      const plain = (text) => (/^'*[=+\-@\t\r]/.test(text) && Number.isNaN(Number(text)) ? `'${text}` : text);
      const cell = (text) => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
      return cells(table).map((row) => row.map((text) => cell(plain(text))).join(",") + "\n").join("");
    },
    Markdown: (table) => {
      const line = (row) => `| ${row.map((text) => text.replace(/[\\`*_[\]<>|&$~]|:(?=[!-~])/g, "\\$&")).join(" | ")} |\n`;
      const [head, ...rows] = cells(table);
      return line(head) + line(numeric(table).map((right) => (right ? "---:" : "---"))) + rows.map(line).join("");
    },
    LaTeX: (table) => latexTable(table.caption.textContent, cells(table), numeric(table)),
  };

  // Copy the styles of the page into the drawing, so that it stands alone.
  const drawn = ["fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-linejoin", "opacity", "font-size",
    "font-family", "text-anchor", "paint-order"];
  function svg(figure) {
    const shown = figure.querySelector("svg[role=img]");
    const copy = shown.cloneNode(true);
    const originals = [shown, ...shown.querySelectorAll("*")];
    [copy, ...copy.querySelectorAll("*")].forEach((element, i) => {
      const style = getComputedStyle(originals[i]);
      for (const name of drawn) element.style.setProperty(name, style.getPropertyValue(name));
      for (const name of ["data-label", "data-command", "tabindex"]) element.removeAttribute(name);
    });
    copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
    for (const side of ["width", "height"]) copy.setAttribute(side, shown.viewBox.baseVal[side]);
    return copy.outerHTML;
  }

  /// Renders a drawing as PNG, at twice its size on the page and on the page's background.
  async function png(figure) {
    const { width, height } = figure.querySelector("svg[role=img]").getBoundingClientRect();
    const picture = new Image();
    picture.src = `data:image/svg+xml,${encodeURIComponent(svg(figure))}`;
    await picture.decode();
    const canvas = document.createElement("canvas");
    canvas.width = 2 * width;
    canvas.height = 2 * height;
    const pen = canvas.getContext("2d");
    pen.fillStyle = getComputedStyle(document.body).backgroundColor;
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.drawImage(picture, 0, 0, canvas.width, canvas.height);
    return new Promise((done) => canvas.toBlob(done));
  }

  // Copies the picture; saves it as a file if the clipboard accepts no pictures.
  async function givePng(menu) {
    const picture = await png(menu.closest("figure"));
    try {
      await navigator.clipboard.write([new ClipboardItem({ "image/png": picture })]);
      answer(menu, "Copied");
    } catch {
      const link = document.createElement("a");
      link.href = URL.createObjectURL(picture);
      link.download = "diagram.png";
      link.click();
      answer(menu, "Saved");
    }
  }

  // Closes the menu, whose label tells the outcome for a moment.
  function answer(menu, text) {
    const label = menu.querySelector("summary");
    menu.open = false;
    label.textContent = text;
    setTimeout(() => (label.textContent = "Copy as"), 1500);
  }

  // Copies text. Some browsers block the clipboard for local files; then the text is shown, selected, for manual copying.
  async function give(menu, text) {
    try {
      await navigator.clipboard.writeText(text);
      answer(menu, "Copied");
    } catch {
      const area = document.createElement("textarea");
      area.value = text;
      area.ariaLabel = "Text to copy";
      area.addEventListener("blur", () => area.remove());
      menu.after(area);
      menu.open = false;
      area.select();
    }
  }

  for (const menu of document.querySelectorAll(".copies")) {
    // The table beside the menu, or the one with a diagram's points.
    const table = () => menu.parentElement.querySelector("table");
    menu.addEventListener("click", ({ target }) => {
      const name = target.dataset.form;
      if (!name) return;
      if (forms[name]) give(menu, forms[name](table()));
      else if (name === "SVG") give(menu, svg(menu.closest("figure")));
      else givePng(menu);
    });
    menu.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || !menu.open) return;
      menu.open = false;
      menu.querySelector("summary").focus();
    });
  }
  addEventListener("click", ({ target }) => {
    for (const menu of document.querySelectorAll(".copies[open]")) menu.open = menu.contains(target);
  });
})();
