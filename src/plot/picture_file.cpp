// SPDX-License-Identifier: Apache-2.0
#include "src/plot/picture_file.h"

#include <fmt/format.h>

#include "base/ends_with.h"
#include "src/config/usage_error.h"
#include "src/files/output_file.h"
#include "src/files/plain_line.h"
#include "src/plot/pdf_module.h"
#include "src/plot/svg_writer.h"

namespace skein {
namespace {

bool IsPdf(const std::string& path) { return EndsWith(path, ".pdf"); }

}  // namespace

void CheckPictureFile(const std::string& path) {
  if (IsPdf(path)) {
    LoadPdfModule();
  } else if (!EndsWith(path, ".svg")) {
    throw UsageError(fmt::format("{}: let the name end in .svg or .pdf", path));
  }
}

void WritePicture(const std::string& path, Picture picture) {
  // Neither format can hold other text.
  picture.title = PlainLine(picture.title);
  for (Shape& shape : picture.shapes) {
    if (auto* const words = std::get_if<Words>(&shape)) words->text = PlainLine(words->text);
  }
  WriteFile(path, IsPdf(path) ? PdfFile(picture) : SvgFile(picture));
}

}  // namespace skein
