#include "turnwright/exchange/notation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "base/say.hpp"
#include "notation_element.hpp"
#include "notation_features.hpp"
#include "notation_units.hpp"

namespace turnwright::exchange {
namespace notated {
namespace {

// Many times what a part document may have; each takes 500 times its own bytes.
constexpr std::size_t kMostStatements = 5000;

// A corner without the names of its elements: after how many outer elements it stands.
struct Corner {
  std::size_t after = 0;
  Edge edge;
};

class Notation {
 public:
  explicit Notation(std::string_view text) : text_(text), mistakes_(text) {}

  Outline read() {
    if (const auto n = utf8_length(text_); n < text_.size()) {
      mistakes_.add(text_.substr(n, 1), tr("a text in UTF-8"), tr("a byte that is none"));
      mistakes_.throw_if_any();
    }
    const auto all = statements(text_);
    if (all.size() > kMostStatements) {
      mistakes_.add(all[kMostStatements], say("at most {} statements", kMostStatements));
      mistakes_.throw_if_any();
    }
    mistakes_.units = units_of(all, mistakes_);
    for (const Word s : all) read_statement(s);
    if (out_.outer.empty() && out_.inner.empty() && mistakes_.none())
      mistakes_.add(text_.substr(0, 0), tr("elements like d50 h7 x 40; d30 k6 x 32"),
                    tr("no element"));
    place_corners();
    check_names();
    mistakes_.throw_if_any();
    out_.faces = std::move(features_.faces);
    out_.tolerances = std::move(features_.tolerances);
    out_.milled = std::move(features_.milled);
    if (mistakes_.units.mm != 1) {
      to_millimetres(mistakes_.units, out_);
      out_.assumed.push_back(
          {"",
           tr("Sizes are read in inches and roughness in microinches; the part is in "
              "millimetres. Diameters of threads and sizes of standards stay as their "
              "designations say.")});
    }
    return std::move(out_);
  }

 private:
  void read_statement(Word statement) {
    const auto colon = statement.find(':');
    if (colon != Word::npos)
      return read_headed(trimmed(statement.substr(0, colon)),
                         trimmed(statement.substr(colon + 1)));
    const auto w = words(statement);
    if (begins_element(w[0])) return add_element(w);
    if (begins_corner(w[0])) {
      for (Edge& e : corner(w, mistakes_))
        corners_.push_back({out_.outer.size(), std::move(e)});
      return;
    }
    if (same(w[0], "centre")) return read_centre(w);
    if (read_feature(w, features_, mistakes_)) return;
    mistakes_.add(
        w[0],
        tr("an element like d50 h7 x 40, M24x1.5 x 25, groove d26 x 3 or bore d20 "
           "H7 x 60, a corner like 1x45, a face, a tolerance, a keyway, a centre hole "
           "like centre right A4/8.5, or a title like name: Pin"));
  }

  // "centre right A4/8.5".
  void read_centre(const std::vector<Word>& w) {
    const bool left = w.size() > 1 && same(w[1], "left");
    if (w.size() != 3 || (!left && !same(w[1], "right")))
      return mistakes_.add(w[0], tr("a centre hole like centre right A4/8.5"));
    std::string designation(w[2]);
    std::ranges::transform(designation, designation.begin(), [](unsigned char c) {
      return static_cast<char>(std::toupper(c));
    });
    out_.centre_holes.push_back(
        {left ? part::End::left : part::End::right, std::move(designation)});
  }

  void add_element(const std::vector<Word>& w) {
    ReadElement read = element(w, mistakes_);
    auto& list = read.inner ? out_.inner : out_.outer;
    read.element.id = fmt::format("{}{}", read.inner ? 'b' : 'd', list.size() + 1);
    list.push_back(std::move(read.element));
  }

  // "name: Pin", "left: 1x45".
  void read_headed(Word head, Word rest) {
    if (same(head, "unit")) return;  // units_of
    if (std::string* text = title(head)) return read_text(*text, head, rest);
    const bool edge =
        same(head, "left") || same(head, "right") || head.find('|') != Word::npos;
    if (!edge)
      return mistakes_.add(
          head, tr("name, material, general, drawing, revision, customer, unit, or "
                   "an edge like left or d1|d2 before the colon"));
    features_.named.push_back({head, true});
    if (rest.empty())
      return mistakes_.add(head, tr("a feature like 1x45 after the colon"));
    for (Edge& e : corner(words(rest), mistakes_)) {
      e.at = std::string(head);
      edges_.push_back(std::move(e));
    }
  }

  std::string* title(Word head) {
    if (same(head, "name")) return &out_.name;
    if (same(head, "material")) return &out_.material;
    if (same(head, "general")) return &out_.general;
    if (same(head, "drawing")) return &out_.title.drawing_number;
    if (same(head, "revision")) return &out_.title.revision;
    if (same(head, "customer")) return &out_.title.customer;
    return nullptr;
  }

  void read_text(std::string& text, Word head, Word rest) {
    if (!text.empty()) return mistakes_.add(head, tr("this line of the title once"));
    if (rest.empty()) return mistakes_.add(head, tr("a text after the colon"));
    if (rest[0] != '"') {
      text = std::string(rest);
      return;
    }
    for (std::size_t i = 1; i < rest.size(); ++i) {
      const bool mark = rest[i] == '"';
      if (mark && i + 1 == rest.size()) return;
      if (mark && rest[++i] != '"') break;
      text += rest[i];
    }
    mistakes_.add(rest, tr("a text that ends with its '\"'"));
  }

  void place_corners() {
    const std::size_t last = out_.outer.size();
    for (Corner& c : corners_) {
      c.edge.at = c.after == 0      ? "left"
                  : c.after == last ? "right"
                                    : fmt::format("d{}|d{}", c.after, c.after + 1);
      out_.edges.push_back(std::move(c.edge));
    }
    std::move(edges_.begin(), edges_.end(), std::back_inserter(out_.edges));
    for (Edge& e : out_.edges)
      if (is_at_end(e.at) && e.fillet_mm) std::swap(e.fillet_mm, e.radius_mm);
  }

  // Of an edge, that of a bore too.
  static bool is_at_end(std::string_view at) {
    return at.starts_with("left") || at.starts_with("right") || at.ends_with("|left") ||
           at.ends_with("|right");
  }

  void check_names() {
    std::unordered_set<std::string> ids;
    for (const auto* list : {&out_.outer, &out_.inner})
      for (const Element& e : *list) ids.insert(e.id);
    const auto known = [&](Word id, bool end_too) {
      return ids.count(std::string(id)) > 0 ||
             (end_too && (id == "left" || id == "right"));
    };
    for (const Named& n : features_.named) {
      const auto bar = n.word.find('|');
      const bool two = bar != Word::npos && n.face_too;
      if (two ? known(n.word.substr(0, bar), true) && known(n.word.substr(bar + 1), false)
              : known(n.word, n.face_too))
        continue;
      mistakes_.add(n.word,
                    say("an element of d1 to d{}{}{}", out_.outer.size(),
                        out_.inner.empty() ? "" : say(", b1 to b{}", out_.inner.size()),
                        n.face_too ? tr(", left, right, or two with | between") : ""));
    }
  }

  std::string_view text_;
  Mistakes mistakes_;
  Outline out_;
  std::vector<Corner> corners_;
  std::vector<Edge> edges_;
  Features features_;
};

}  // namespace
}  // namespace notated

Outline read_notation(std::string_view text) { return notated::Notation(text).read(); }

}  // namespace turnwright::exchange
