#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace turnwright::service {

/// Finds a body among the bytes of a connection: as many as Content-Length says, or
/// chunks (RFC 9112, 7.1).  Every byte is judged when it arrives, so that nobody waits
/// for the end of a line that is wrong already.
class Framing {
 public:
  enum class State {
    more,       ///< the body goes on
    done,       ///< what follows is another call
    wrong,      ///< no chunk: no hexadecimal size, a line end that is not CRLF, ..
    too_large,  ///< more than the limit
    too_long    ///< chunk extensions and trailers of more than their limit
  };

  static Framing of_length(std::uint64_t bytes);
  /// @param most  bytes of content; @param most_lines  bytes of all chunk extensions and
  ///   trailers together, which are read and ignored.
  static Framing of_chunks(std::uint64_t most, std::size_t most_lines);

  struct Piece {
    std::string_view content;  ///< of the body; may be empty
    std::size_t taken = 0;     ///< bytes, the content included
  };
  /// The next piece of the body at the front of `bytes`: all that are framing, up to the
  /// end of the first run of content.
  Piece next(std::string_view bytes);
  State state() const { return state_; }

 private:
  enum class At {
    size,           // first digit of a chunk's size
    more_size,      // further digits
    blank,          // white space before an extension
    extension,      // from ";" to the end of the line
    size_end,       // LF of that line
    content,        // of a chunk, or of a body with a length
    content_cr,     // CR behind the content
    content_end,    // LF behind it
    trailer,        // first character of a trailer, or of the last line
    trailer_name,   // up to ":"
    trailer_value,  // to the end of the line
    trailer_end,    // LF of that line
    last            // LF of the last line
  };

  At after(char c);
  At after_digit(char c);
  At after_size(char c);
  At line(char c, At same, At end);
  At expect(char c, char wanted, At then);
  At fail(State why);

  State state_ = State::more;
  At at_ = At::content;
  std::uint64_t left_ = 0;        // bytes of the chunk that have not arrived
  std::uint64_t most_ = 0;        // bytes that further chunks may have
  std::uint64_t most_lines_ = 0;  // bytes that further lines may have
  unsigned digits_ = 0;           // of the chunk's size
  bool chunked_ = false;
};

}  // namespace turnwright::service
