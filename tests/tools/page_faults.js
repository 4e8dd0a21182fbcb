// SPDX-License-Identifier: Apache-2.0
// What is wrong with the text of a page, for test_evidence_site.py: text that is cut, and text that
// is hard to read. Gives a list of sentences.
(() => {
  const faults = [];
  const shown = (node) => node.textContent.trim().slice(0, 40);

  // A colour as red, green, blue and opacity.
  const parts = (colour) => {
    const found = colour.match(/[\d.]+/g).map(Number);
    return found.length === 3 ? [...found, 1] : found;
  };

  const luminance = ([r, g, b]) => {
    const part = (value) => {
      const linear = value / 255;
      return linear <= 0.03928 ? linear / 12.92 : ((linear + 0.055) / 1.055) ** 2.4;
    };
    return 0.2126 * part(r) + 0.7152 * part(g) + 0.0722 * part(b);
  };

  const background = (element) => {
    for (let at = element; at; at = at.parentElement) {
      const colour = parts(getComputedStyle(at).backgroundColor);
      if (colour[3] === 1) return colour;
    }
    return [255, 255, 255, 1];
  };

  const contrast = (one, other) => {
    const [light, dark] = [luminance(one), luminance(other)].sort((a, b) => b - a);
    return (light + 0.05) / (dark + 0.05);
  };

  // The text's place is compared with everything that would cut it: boxes that clip, the window.
  const check = (node) => {
    const element = node.parentElement;
    const range = document.createRange();
    range.selectNodeContents(node);
    let scrolled = false;
    for (const box of range.getClientRects()) {
      for (let at = element; at && at !== document.body; at = at.parentElement) {
        const clips = getComputedStyle(at).overflowX;
        if (clips === "auto" || clips === "scroll") { scrolled = true; break; }
        const edge = at.getBoundingClientRect();
        if (clips !== "visible" && at.namespaceURI.endsWith("xhtml")
            && (box.right > edge.right + 1 || box.left < edge.left - 1)) {
          faults.push(`is cut: ${shown(node)}`);
        }
      }
      if (!scrolled && box.width > 0 && (box.right > innerWidth + 1 || box.left < -1)) {
        faults.push(`is outside of the window: ${shown(node)}`);
      }
    }
    if (element.namespaceURI.endsWith("xhtml")) {
      const ratio = contrast(parts(getComputedStyle(element).color), background(element));
      if (ratio < 4.5) faults.push(`has a contrast of ${ratio.toFixed(1)}: ${shown(node)}`);
    }
  };

  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const element = node.parentElement;
    if (node.textContent.trim() && element.checkVisibility() && !element.closest(".skip, script")) {
      check(node);
    }
  }
  for (const text of document.querySelectorAll("svg.graph text")) {
    const room = text.parentElement.querySelector("rect").getBBox();
    const words = text.getBBox();
    if (words.x < room.x || words.x + words.width > room.x + room.width) {
      faults.push(`is wider than its box: ${shown(text)}`);
    }
  }
  if (document.documentElement.scrollWidth > innerWidth) faults.push("the page is too wide");
  return faults;
})()
