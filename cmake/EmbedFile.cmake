# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a C++ source that defines skein::data::SYMBOL with the bytes of INPUT.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
file(WRITE ${OUTPUT} "#include <string_view>
namespace skein::data {
static const char bytes[] = {${bytes}};
extern const std::string_view ${SYMBOL};
const std::string_view ${SYMBOL}(bytes, sizeof(bytes));
}  // namespace skein::data
")
