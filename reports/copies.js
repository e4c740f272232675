"use strict";
// Copies tables for spreadsheets, Markdown and LaTeX, and diagrams as pictures.
(() => {
  const cells = (table) => [...table.rows].map((row) => [...row.cells].map((cell) => cell.textContent.trim()));
  const numeric = (table) => [...table.rows[0].cells].map((cell) => cell.classList.contains("number"));
  const latex = (text) => [...text].map((sign) => latexSigns[sign] || sign).join("");

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
    LaTeX: (table) => {
      const line = (row) => `  ${row.map(latex).join(" & ")} \\\\\n`;
      const [head, ...rows] = cells(table);
      const columns = numeric(table).map((right) => (right ? "r" : "l")).join("");
      return `% needs \\usepackage{booktabs}\n\\begin{tabular}{${columns}}\n  \\toprule\n${line(head)}  \\midrule\n` +
        `${rows.map(line).join("")}  \\bottomrule\n\\end{tabular}\n`;
    },
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
  async function givePng(button) {
    const picture = await png(button.closest("figure"));
    try {
      await navigator.clipboard.write([new ClipboardItem({ "image/png": picture })]);
      answer(button, "Copied");
    } catch {
      const link = document.createElement("a");
      link.href = URL.createObjectURL(picture);
      link.download = "diagram.png";
      link.click();
      answer(button, "Saved");
    }
  }

  function answer(button, text) {
    const name = button.dataset.form;
    button.textContent = text;
    setTimeout(() => (button.textContent = name), 1500);
  }

  // Copies text. Some browsers block the clipboard for local files; then the text is shown, selected, for manual copying.
  async function give(button, text) {
    try {
      await navigator.clipboard.writeText(text);
      answer(button, "Copied");
    } catch {
      const area = document.createElement("textarea");
      area.value = text;
      area.ariaLabel = button.ariaLabel;
      area.addEventListener("blur", () => area.remove());
      button.after(area);
      area.select();
    }
  }

  for (const button of document.querySelectorAll(".copies button")) {
    button.addEventListener("click", () => {
      const form = forms[button.dataset.form];
      if (form) give(button, form(button.closest(".scroll").querySelector("table")));
      else if (button.dataset.form === "SVG") give(button, svg(button.closest("figure")));
      else givePng(button);
    });
  }
})();
