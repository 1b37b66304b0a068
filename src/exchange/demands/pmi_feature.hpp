#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "pmi.hpp"

namespace turnwright::exchange {

/// Which faces belong to which shape aspect.  Read once from all relations of a file:
///
///     composite -> member, derived aspect -> base, datum -> its feature or target,
///     target -> the feature it lies on, dimension -> what it applies to
class Features {
 public:
  /// What is broken in the relations is told under `unread`.
  Features(const Exchange& file, std::vector<Remark>& unread);

  /// The feature of an aspect, a datum or a size.  Relations in a circle are walked once.
  Feature of(const Instance& aspect);

  /// @throws InputError if the features asked for so far would have had more relations and
  ///         faces than 16 times the instances of the file: a few are shared by many.
  void throw_if_spent() const;

 private:
  struct Relation {
    std::uint32_t from = 0, to = 0;  ///< indices of instances
    bool to_item = false;            ///< geometry, not a further aspect
    bool axis = false;               ///< `from` is the centre of `to`
  };
  void add_relation(const Instance& relation);
  void add_items(const Instance& usage);
  void add(const Instance& from, const Instance& to, bool to_item, bool axis);
  void add_item(const Instance& item, Feature& feature) const;

  const Exchange* file_;
  std::vector<Relation> relations_;  ///< by `from`, then in the order of the file
  std::vector<std::uint32_t> seen_;  ///< number of the walk that met an instance last
  std::uint32_t walk_ = 0;
  std::size_t left_;  ///< steps
};

/// What a size applies to and its name: `DIMENSIONAL_SIZE(#aspect,'diameter')`, its subtypes,
/// and complex instances.  Nothing if the instance is no size.
struct SizeOf {
  Parameter of, name;
};
std::optional<SizeOf> size_of(const Instance& instance);

}  // namespace turnwright::exchange
