#include "dxf_file.hpp"

#include <charconv>
#include <cmath>
#include <utility>

#include "exchange/text/notation_words.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::exchange::dxf {
namespace {

std::string_view stripped(std::string_view s) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!s.empty() && blank(s.front())) s.remove_prefix(1);
  while (!s.empty() && blank(s.back())) s.remove_suffix(1);
  return s;
}

std::string at_line(std::size_t line) { return "line " + std::to_string(line); }

std::string quoted(std::string_view s) {
  const auto begins = notated::beginning(s, 40);
  return '"' + std::string(begins) + (begins.size() < s.size() ? "..\"" : "\"");
}

template <class Number>
std::optional<Number> parsed(std::string_view s) {
  s = stripped(s);
  if (!s.empty() && s.front() == '+') s.remove_prefix(1);
  Number x{};
  const auto read = std::from_chars(s.data(), s.data() + s.size(), x);
  if (read.ec != std::errc() || read.ptr != s.data() + s.size()) return std::nullopt;
  return x;
}

bool continues_entity(std::string_view type) {
  return type == "VERTEX" || type == "ATTRIB" || type == "SEQEND";
}

// Walks through the sections of a file.
class Sections {
 public:
  explicit Sections(std::string_view text) : text_(text), groups_(text, 1) {}

  File read() {
    bool entities = false;
    while (auto g = groups_.next()) {
      if (g->code != 0 || g->value == "ENDSEC") continue;
      if (g->value == "EOF") break;
      if (g->value != "SECTION")
        refuse(at_line(g->line), quoted(g->value), tr("a SECTION of a DXF file"));
      const auto name = need(to_translate("the name of a section"));
      if (name.value == "HEADER")
        read_header();
      else if (name.value == "TABLES")
        read_tables();
      else if (name.value == "BLOCKS")
        read_blocks();
      else if (name.value == "ENTITIES")
        read_entities(out_.entities, "ENDSEC"), entities = true;
      else
        skip();
    }
    if (!entities) refuse("", tr("no section ENTITIES"), tr("a drawing in a DXF file"));
    return std::move(out_);
  }

 private:
  Group need(const char* what) {
    auto g = groups_.next();
    if (!g) refuse("the end", tr("a file that breaks off"), tr(what));
    return *g;
  }

  static bool ends(const Group& g) { return g.code == 0 && g.value == "ENDSEC"; }

  void skip() {
    while (!ends(need(to_translate("the end of the section, ENDSEC")))) {
    }
  }

  void read_header() {
    std::string variable;
    bool first = false;
    for (auto g = need("ENDSEC"); !ends(g);
         g = need(to_translate("the end of the section, ENDSEC")))
      if (g.code == 9)
        variable = g.value, first = true;
      else if (std::exchange(first, false))
        out_.header.emplace(variable, g);
  }

  void read_tables() {
    Layer* layer = nullptr;
    DimensionStyle* style = nullptr;
    for (auto g = need("ENDSEC"); !ends(g);
         g = need(to_translate("the end of the section, ENDSEC"))) {
      if (g.code == 0) {
        layer = g.value == "LAYER" ? &unnamed_ : nullptr;
        style = g.value == "DIMSTYLE" ? &unnamed_style_ : nullptr;
      }
      if (style) read_style(g, style);
      if (!layer) continue;
      if (g.code == 2) {
        layer = &out_.layers[capital(g.value)];
        *layer = {};
      }
      if (g.code == 70 && (integer(g) & 1) != 0) layer->visible = false;
      if (g.code == 62 && integer(g) < 0) layer->visible = false;
      if (g.code == 6) layer->linetype = g.value;
    }
  }

  void read_style(const Group& g, DimensionStyle*& style) {
    if (g.code == 2) style = &(out_.styles[capital(g.value)] = {});
    if (g.code == 3) style->affixed = !g.value.empty() && g.value != "<>";
    if ((g.code == 71 || g.code == 72) && integer(g) != 0) style->limits = true;
    if (g.code == 144) style->factor = number(g);
  }

  void read_blocks() {
    for (auto g = need("ENDSEC"); !ends(g);
         g = need(to_translate("the end of the section, ENDSEC"))) {
      if (g.code != 0 || g.value != "BLOCK") continue;
      std::string name;
      Block block;
      for (g = need("ENDBLK"); g.code != 0;
           g = need(to_translate("the end of the block, ENDBLK"))) {
        if (g.code == 2) name = capital(g.value);
        if (g.code == 10) block.x = number(g);
        if (g.code == 20) block.y = number(g);
      }
      read_entities(block.entities, "ENDBLK", g);
      out_.blocks.insert_or_assign(std::move(name), std::move(block));
    }
  }

  // Up to the group that ends them; `g` is read already.
  void read_entities(std::vector<Entity>& list, std::string_view end,
                     std::optional<Group> g = {}) {
    if (!g) g = need(to_translate("an entity or ENDSEC"));
    std::size_t before = groups_.position();
    while (g->code != 0 || g->value != end) {
      if (g->code == 0 && (g->value == "ENDSEC" || g->value == "EOF"))
        refuse(at_line(g->line), quoted(g->value), std::string(end));
      if (g->code == 0 && !continues_entity(g->value)) {
        list.push_back({g->value, text_.substr(groups_.position(), 0), g->line + 2});
        before = groups_.position();
      } else if (list.empty() && g->code == 0) {
        refuse(at_line(g->line), quoted(g->value), tr("a POLYLINE or INSERT before it"));
      }
      g = need(end == "ENDSEC" ? to_translate("the end of the section, ENDSEC")
                               : to_translate("the end of the block, ENDBLK"));
      if (!list.empty() && (g->code != 0 || continues_entity(g->value)))
        list.back().body = text_.substr(before, groups_.position() - before);
    }
  }

  std::string_view text_;
  Groups groups_;
  File out_;
  Layer unnamed_;
  DimensionStyle unnamed_style_;
};

}  // namespace

void refuse(std::string place, std::string got, std::string expected) {
  throw InputError("drawing",
                   {{std::move(place), std::move(got), std::move(expected), "dxf"}});
}

std::string capital(std::string_view s) {
  std::string out(s);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return out;
}

std::string_view Groups::take_line() {
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  const auto line = text_.substr(at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  ++line_;
  return line;
}

std::optional<Group> Groups::next() {
  for (;;) {
    if (at_ >= text_.size()) return std::nullopt;
    Group g{.code = 0, .value = {}, .line = line_};
    const auto code_text = take_line();
    if (at_ >= text_.size() && stripped(code_text).empty()) return std::nullopt;
    const auto code = parsed<int>(code_text);
    if (!code)
      refuse(at_line(g.line), quoted(stripped(code_text)),
             tr("a group code, a whole number"));
    if (at_ >= text_.size())
      refuse(at_line(g.line), tr("a group code without its value"),
             tr("a value on the next line"));
    g.code = *code;
    g.value = stripped(take_line());
    constexpr int kComment = 999;
    if (g.code != kComment) return g;
  }
}

double number(const Group& group) {
  const auto x = parsed<double>(group.value);
  if (!x || !std::isfinite(*x))
    refuse(at_line(group.line + 1), quoted(group.value), tr("a number"));
  return *x;
}

long integer(const Group& group) {
  const auto x = parsed<long>(group.value);
  if (!x) refuse(at_line(group.line + 1), quoted(group.value), tr("a whole number"));
  return *x;
}

std::optional<Group> Entity::first(int code) const {
  Groups all = groups();
  while (const auto g = all.next()) {
    if (g->code == code) return g;
    if (g->code == 0) break;
  }
  return std::nullopt;
}

double Entity::number_or(int code, double fallback) const {
  const auto g = first(code);
  return g ? number(*g) : fallback;
}

long Entity::integer_or(int code, long fallback) const {
  const auto g = first(code);
  return g ? integer(*g) : fallback;
}

std::string_view Entity::text_or(int code, std::string_view fallback) const {
  const auto g = first(code);
  return g ? g->value : fallback;
}

std::string Entity::name() const {
  const auto handle = text_or(5, "");
  return std::string(type) +
         (handle.empty() ? " of " + at_line(line - 1) : " " + std::string(handle));
}

File read_file(std::string_view text) {
  constexpr std::string_view kBinary = "AutoCAD Binary DXF", kBom = "\xef\xbb\xbf";
  if (text.substr(0, kBinary.size()) == kBinary)
    refuse("", tr("a binary DXF file"), tr("an ASCII one: save it as such"));
  if (text.substr(0, 3) == "AC1")
    refuse("", tr("a DWG file"), tr("DXF: save the drawing as such"));
  if (text.substr(0, kBom.size()) == kBom) text.remove_prefix(kBom.size());
  return Sections(text).read();
}

}  // namespace turnwright::exchange::dxf
