"use strict";
// Tables for LaTeX, with cells wrapped to fit a column of an article: the same as reports/latex_table.cpp writes.
const latexTable = (() => {
  const column = 3.3 * 72.27, page = 7 * 72.27, gap = 6; // pt

  const escaped = (text) => {
    let result = "";
    const signs = Object.keys(latexSigns);
    for (let rest = text; rest;) {
      const sign = signs.find((known) => rest.startsWith(known)) ?? String.fromCodePoint(rest.codePointAt(0));
      result += latexSigns[sign] ?? sign;
      rest = rest.slice(sign.length);
    }
    return result;
  };

  // Upper estimates of widths in Computer Modern of 8 pt.
  const widthOfSign = (sign) =>
    sign > "\x7f" ? 9 : sign === " " ? 3 : "mwMW%&@#".includes(sign) ? 8.8 : /[A-Z<>=+|~]/.test(sign) ? 6.7
      : "ijlft.,:;'()[]".includes(sign) ? 3.4 : 4.8;
  const widthOf = (text) => [...text].reduce((sum, sign) => sum + widthOfSign(sign), 0);

  // The longest part of a text that LaTeX does not break: a word, or its part up to a hyphen.
  function longestPart(text) {
    let longest = 0, part = 0, before = "";
    for (const sign of text) {
      if (sign !== " ") part += widthOfSign(sign);
      longest = Math.max(longest, part);
      if (sign === " " || (sign === "-" && /[A-Za-z]/.test(before))) part = 0;
      before = sign;
    }
    return longest;
  }

  // The number of first columns that identify the rows.
  function leadingColumns(rows, columns) {
    for (let count = 1; count < columns; ++count) {
      if (new Set(rows.map((row) => JSON.stringify(row.slice(0, count)))).size === rows.length) return count;
    }
    return 1;
  }

  // Parts of a wide table, each of which starts with the leading columns.
  function partsWithin(room, widths, leading) {
    const begin = widths.slice(0, leading).map((_, column) => column);
    const beginWidth = begin.reduce((sum, column) => sum + gap + widths[column], 0);
    if (leading > 1 && beginWidth > Math.floor(room / 2)) return partsWithin(room, widths, 1);
    const parts = [[...begin]];
    let used = beginWidth;
    for (let column = begin.length; column < widths.length; ++column) {
      if (used + gap + widths[column] > room && parts.at(-1).length > begin.length) {
        parts.push([...begin]);
        used = beginWidth;
      }
      parts.at(-1).push(column);
      used += gap + widths[column];
    }
    return parts;
  }

  const total = (extents, width) =>
    extents.reduce((sum, extent) => sum + extent[width], gap * (extents.length - 1));

  function tabular(head, rows, numeric, part, all, room) {
    const extents = part.map((column) => all[column]);
    const least = total(extents, "least"), natural = total(extents, "natural");
    const share = natural <= room || least > room ? 1 : (room - least) / (natural - least);
    const form = part.map((column, i) => {
      const { least, natural } = extents[i], width = least + share * (natural - least);
      if (width >= natural) return numeric[column] ? "r" : "l";
      const side = numeric[column] ? "raggedleft" : "raggedright";
      return `>{\\${side}\\arraybackslash{}}p{${(Math.floor(10 * width) / 10).toFixed(1)}pt}`;
    });
    const line = (row) => `  ${part.map((column) => escaped(row[column])).join(" & ")} \\\\\n`;
    return `\\begin{tabular}{@{}${form.join("")}@{}}\n  \\toprule\n${line(head)}  \\midrule\n` +
      `${rows.map(line).join("")}  \\bottomrule\n\\end{tabular}`;
  }

  // Formats a table whose first row is its head.
  return (title, [head, ...rows], numeric) => {
    const all = head.map((_, column) => {
      const cells = [head, ...rows].map((row) => row[column]);
      return { least: Math.max(...cells.map(longestPart)), natural: Math.max(...cells.map(widthOf)) };
    });
    const narrow = total(all, "least") <= column, room = narrow ? column : page;
    const parts = partsWithin(Math.floor(room), all.map(({ least }) => Math.ceil(least)), leadingColumns(rows, head.length));
    const fits = narrow ? "fits a column of 3.3 in" : "fits a page of 7 in, in a document of two columns with table*";
    return `% ${escaped(title)}\n% needs \\usepackage{array,booktabs}; ${fits}\n` +
      `{\\footnotesize\\setlength{\\tabcolsep}{${gap / 2}pt}%\n` +
      `${parts.map((part) => tabular(head, rows, numeric, part, all, room)).join("\\par\\medskip\n")}}\n`;
  };
})();
