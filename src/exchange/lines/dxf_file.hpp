#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

/// ASCII DXF: groups, sections, entities; nothing of what they draw.  All texts are places
/// in the file, which must outlive them.
namespace turnwright::exchange::dxf {

[[noreturn]] void refuse(std::string place, std::string got, std::string expected);

/// A group code, the value on the line below it, and the number of the code's line.
struct Group {
  int code = 0;
  std::string_view value;
  std::size_t line = 0;
};

/// Reads one group after the other.
class Groups {
 public:
  Groups(std::string_view text, std::size_t line) : text_(text), line_(line) {}
  /// The next group, nothing at the end.
  /// @throws InputError if a code is no number or has no value.
  std::optional<Group> next();
  /// Place in the text behind the group that was read last.
  std::size_t position() const { return at_; }

 private:
  std::string_view take_line();
  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
};

/// The value as a number.
/// @throws InputError if it is none, or not finite.
double number(const Group& group);
long integer(const Group& group);

/// The groups of an entity, those of its vertices and attributes included.
struct Entity {
  std::string_view type;
  std::string_view body;  ///< behind the group that names it
  std::size_t line = 0;   ///< of `body`

  Groups groups() const { return {body, line}; }
  /// The first group of this code, before its vertices.
  std::optional<Group> first(int code) const;
  double number_or(int code, double fallback) const;
  long integer_or(int code, long fallback) const;
  std::string_view text_or(int code, std::string_view fallback) const;
  /// "LINE 2F" by its handle, "LINE of line 120" without it.
  std::string name() const;
};

struct Layer {
  bool visible = true;
  std::string_view linetype;
};

struct Block {
  double x = 0, y = 0;  ///< base point
  std::vector<Entity> entities;
};

/// What a style adds to the dimensions that refer to it.
struct DimensionStyle {
  bool limits = false;   ///< DIMTOL, DIMLIM
  bool affixed = false;  ///< DIMPOST: text before or behind the size
  double factor = 1;     ///< DIMLFAC: sizes shown for a length drawn
};

struct File {
  std::unordered_map<std::string, Group> header;  ///< "$INSUNITS": its first value
  std::unordered_map<std::string, Layer> layers;  ///< by their names in capitals
  std::unordered_map<std::string, DimensionStyle> styles;
  std::unordered_map<std::string, Block> blocks;
  std::vector<Entity> entities;
};

/// Capital letters for a to z: names in a DXF differ by more than the case.
std::string capital(std::string_view s);

/// @throws InputError for what is no ASCII DXF, breaks off, or has no entities.
File read_file(std::string_view text);

}  // namespace turnwright::exchange::dxf
