#include "service/http/framing.hpp"

#include <gtest/gtest.h>

#include <string>

namespace turnwright::service::framing_test {
namespace {

struct Read {
  std::string content;
  std::size_t taken = 0;
  Framing::State state = Framing::State::more;
};

/// What a body in pieces of `size` bytes is read as.
Read read(Framing framing, std::string_view bytes, std::size_t size) {
  Read all;
  while (all.taken < bytes.size() && framing.state() == Framing::State::more) {
    const auto piece = framing.next(bytes.substr(all.taken, size));
    all.content += piece.content;
    all.taken += piece.taken;
  }
  all.state = framing.state();
  return all;
}

constexpr std::uint64_t kMost = 1000;
constexpr std::size_t kMostLines = 40;

Framing chunks() { return Framing::of_chunks(kMost, kMostLines); }

TEST(Framing, FindsTheBodyInPiecesOfAnySize) {
  const std::string chunked =
      "4\r\nWiki\r\n05;a=b;c=\"d;e\"\r\npedia\r\nE\t;x\r\n in\r\n\r\nchunks.\r\n"
      "000\r\nA: b\r\nC:\r\n\r\n";
  for (std::size_t size = 1; size <= chunked.size() + 4; ++size) {
    const auto all = read(chunks(), chunked + "GET ", size);
    EXPECT_EQ(all.content, "Wikipedia in\r\n\r\nchunks.");
    EXPECT_EQ(all.taken, chunked.size());
    EXPECT_EQ(all.state, Framing::State::done);
    const auto plain = read(Framing::of_length(7), "content of 7", size);
    EXPECT_EQ(plain.content, "content");
    EXPECT_EQ(plain.taken, 7u);
    EXPECT_EQ(plain.state, Framing::State::done);
  }
  EXPECT_EQ(Framing::of_length(0).state(), Framing::State::done);
}

// RFC 9112, 7.1: with the byte that cannot be, not at the end of a line that never comes.
TEST(Framing, JudgesEveryByteWhenItArrives) {
  for (const char* good : {"0x",
                           "-",
                           "+",
                           " ",
                           "g",
                           "\r",
                           "\n",
                           "1 \r",
                           "1 x",
                           "1\n",
                           "1\rx",
                           "1;\x01",
                           "1;a\n",
                           "1\r\nax",
                           "1\r\na\rx",
                           "1\r\na\n",
                           "0 \r",
                           "0;\x7f",
                           "0\r\nA\r",
                           "0\r\n ",
                           "0\r\n:",
                           "0\r\nA ",
                           "0\r\nA: \x01",
                           "0\r\nA: b\n",
                           "0\r\n\n",
                           "0\n",
                           "0\r\n\rx",
                           "00000000000000000",
                           "12345678123456781"}) {
    const std::string_view all = good;
    const auto before = read(chunks(), all.substr(0, all.size() - 1), 1);
    EXPECT_EQ(before.state, Framing::State::more) << all;
    EXPECT_EQ(read(chunks(), all, 1).state, Framing::State::wrong) << all;
  }
}

TEST(Framing, LimitsTheContentAndWhatIsIgnored) {
  const auto state = [](const std::string& bytes) {
    return read(chunks(), bytes, 7).state;
  };
  EXPECT_EQ(state("3e8\r\n"), Framing::State::more);
  EXPECT_EQ(state("3e9\r\n"), Framing::State::too_large);
  EXPECT_EQ(state("1\r\n1\r\n3e7\r\n"), Framing::State::more);
  EXPECT_EQ(state("1\r\n1\r\n3e8\r\n"), Framing::State::too_large);
  EXPECT_EQ(state("ffffffffffffffff\r\n"), Framing::State::too_large);
  EXPECT_EQ(state("1;" + std::string(kMostLines, 'a') + "\r\n"), Framing::State::more);
  EXPECT_EQ(state("1;" + std::string(kMostLines + 1, 'a')), Framing::State::too_long);
  EXPECT_EQ(state("1;" + std::string(kMostLines, 'a') + "\r\n1\r\n2;b"),
            Framing::State::too_long);
  EXPECT_EQ(state("0\r\na:" + std::string(kMostLines, 'b')), Framing::State::too_long);
}

}  // namespace
}  // namespace turnwright::service::framing_test
