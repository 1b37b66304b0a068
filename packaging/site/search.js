// Search in the page itself, so that it works where the site is a folder of files: browsers
// let such pages neither start workers nor read JSON.  Takes the place of mkdocs' main.js and
// needs search_index.js (window.searchIndex) and lunr.js.
(function () {
  "use strict";
  let index = null, documents = new Map();

  function load(name) {
    return new Promise(function (done, failed) {
      const script = document.createElement("script");
      script.src = base_url + "/search/" + name;
      script.onload = done;
      script.onerror = failed;
      document.head.append(script);
    });
  }

  async function prepare() {
    await load("lunr.js");
    await load("search_index.js");
    for (const one of window.searchIndex.docs) documents.set(one.location, one);
    index = lunr(function () {
      this.ref("location");
      this.field("title", {boost: 5});
      this.field("text");
      for (const one of documents.values()) this.add(one);
    });
  }

  // Words that begin as typed; all of them count.
  function find(words) {
    return index.query(function (query) {
      for (const word of words) {
        query.term(word, {boost: 10});
        query.term(word, {wildcard: lunr.Query.wildcard.TRAILING});
      }
    });
  }

  function show(results) {
    const list = document.getElementById("mkdocs-search-results");
    list.replaceChildren();
    if (!results.length) list.textContent = "Nothing found";
    for (const result of results.slice(0, 30)) {
      const one = documents.get(result.ref), link = document.createElement("a");
      link.href = base_url + "/" + one.location;
      link.textContent = one.title;
      const heading = document.createElement("h3"), text = document.createElement("p");
      heading.append(link);
      text.textContent = one.text.slice(0, 200);
      list.append(heading, text);
    }
  }

  let ready = null;
  async function search(input) {
    await (ready ??= prepare());
    const words = input.value.toLowerCase().match(/[\p{L}\p{N}_.]+/gu) ?? [];
    show(words.length ? find(words) : []);
  }

  document.addEventListener("DOMContentLoaded", function () {
    const input = document.getElementById("mkdocs-search-query");
    if (!input) return;
    input.addEventListener("input", () => search(input));
    const asked = new URLSearchParams(location.search).get("q");  // index.html?q=chatter
    if (asked) {
      input.value = asked;
      search(input);
    }
  });
})();
