#pragma once
#include <atomic>
#include <cstddef>

namespace turnwright::service {

/// Bytes that all calls together may hold, counted before they are allocated.  A quarter
/// is kept for those that hold little, so that large bodies never shut small calls out.
/// May be used from several threads.
class Budget {
 public:
  static constexpr std::size_t kSmall = 65'536;  ///< bytes; a call up to this is small

  explicit Budget(std::size_t most) : most_(most) {}
  Budget(const Budget&) = delete;
  Budget& operator=(const Budget&) = delete;

  /// Whether a call of that size would find room now.
  bool has_room(std::size_t bytes) const;
  std::size_t used() const { return used_; }

  /// What one call holds; given back when it ends.
  class Share {
   public:
    explicit Share(Budget& budget) : budget_(budget) {}
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;
    ~Share() { budget_.used_ -= bytes_; }

    /// Makes the share larger or smaller.  @return false, with nothing changed, if there
    /// is no room.
    bool resize(std::size_t bytes);
    std::size_t bytes() const { return bytes_; }

   private:
    Budget& budget_;
    std::size_t bytes_ = 0;
  };

 private:
  std::size_t most_for(std::size_t bytes) const;

  const std::size_t most_;
  std::atomic<std::size_t> used_ = 0;
};

}  // namespace turnwright::service
