// SPDX-License-Identifier: Apache-2.0
#include "src/plot/picture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "src/config/usage_error.h"
#include "src/files/output_file.h"
#include "src/plot/pdf_module.h"
#include "src/plot/svg_writer.h"

namespace skein {
namespace {

bool EndsIn(const std::string& path, const std::string& ending) {
  return path.size() > ending.size() && path.substr(path.size() - ending.size()) == ending;
}

bool IsPdf(const std::string& path) { return EndsIn(path, ".pdf"); }

/// Valid UTF-8 without control characters, which neither format can hold.
std::string Drawable(const std::string& text) {
  using Json = nlohmann::json;
  auto clean = Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace))
                   .get<std::string>();
  std::replace_if(
      clean.begin(), clean.end(),
      [](char letter) { return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7F; }, ' ');
  return clean;
}

}  // namespace

void CheckPictureFile(const std::string& path) {
  if (IsPdf(path)) {
    LoadPdfModule();
  } else if (!EndsIn(path, ".svg")) {
    throw UsageError(fmt::format("{}: let the name end in .svg or .pdf", path));
  }
}

void WritePicture(const std::string& path, Picture picture) {
  picture.title = Drawable(picture.title);
  for (Shape& shape : picture.shapes) {
    if (auto* const words = std::get_if<Words>(&shape)) words->text = Drawable(words->text);
  }
  WriteFile(path, IsPdf(path) ? PdfFile(picture) : SvgFile(picture));
}

}  // namespace skein
