# Writes OUT, the C++ that gives the bytes of the file IN.
file(READ ${IN} bytes HEX)
string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
file(WRITE ${OUT} "#include \"service/http/page.hpp\"

namespace turnwright::service {
namespace {
constexpr unsigned char kPage[] = {
${bytes}};
}  // namespace

std::string built_in_page() { return {std::begin(kPage), std::end(kPage)}; }

}  // namespace turnwright::service
")
