// A fuzzer without libFuzzer, for any compiler and the short run of every test: the kept
// corpus once, then mutations of it in a fixed order.
// Usage: fuzz --target=NAME --corpus=FILE.jsonl --runs=N
#include <cstdint>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "option.hpp"

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed);

namespace {

constexpr std::size_t kLongest = 20000;
std::minstd_rand random_number(1);

std::size_t below(std::size_t n) { return random_number() % n; }

/// Bytes are stored as the characters of the same numbers.
std::vector<std::uint8_t> bytes(const std::string& line) {
  std::vector<std::uint8_t> data;
  const auto text = nlohmann::json::parse(line).get<std::string>();
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<std::uint8_t>(text[i]);
    data.push_back(
        c < 0x80 ? c : static_cast<std::uint8_t>((c & 3) << 6 | (text[++i] & 0x3f)));
  }
  return data;
}

void run(const std::vector<std::uint8_t>& input) {
  (void)LLVMFuzzerTestOneInput(input.data(), input.size());
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size,
                                        std::size_t most) {
  if (size == 0 || (below(3) == 0 && size < most)) {
    const std::size_t at = below(size + 1);
    std::copy_backward(data + at, data + size, data + size + 1);
    data[at] = static_cast<std::uint8_t>(below(256));
    return size + 1;
  }
  const std::size_t at = below(size);
  if (below(2)) {
    data[at] ^= static_cast<std::uint8_t>(1u << below(8));
    return size;
  }
  std::copy(data + at + 1, data + size, data + at);
  return size - 1;
}

int main(int argc, char** argv) {
  using turnwright::fuzz::option;
  LLVMFuzzerInitialize(&argc, &argv);
  std::ifstream file(option(argc, argv, "corpus"));
  std::vector<std::vector<std::uint8_t>> corpus;
  for (std::string line; std::getline(file, line);) corpus.push_back(bytes(line));
  if (corpus.empty()) {
    std::cerr << "no corpus\n";
    return 2;
  }
  for (const auto& input : corpus) run(input);
  const int runs = std::stoi(option(argc, argv, "runs"));
  for (int i = 0; i < runs; ++i) {
    auto input = corpus[below(corpus.size())];
    std::size_t size = input.size();
    input.resize(std::max(size, kLongest));
    size = LLVMFuzzerCustomMutator(input.data(), size, input.size(),
                                   static_cast<unsigned>(random_number()));
    input.resize(size);
    run(input);
  }
  std::cout << corpus.size() << " kept, " << runs << " mutated\n";
}
