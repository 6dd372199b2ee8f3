// SPDX-License-Identifier: Apache-2.0
#include "src/plot/pdf_module.h"

#include "base/error.h"
#include "base/shared_module.h"

namespace skein {

const PdfModule& LoadPdfModule(const std::string& file) {
  try {
    return LoadModule<PdfModuleEntry>(file, kPdfModuleEntry, SKEIN_BUILD_ID);
  } catch (const Error& error) {
    throw Error("PDF cannot be written" +
                WhyNotLoaded(error,
                             "install cairo (with Debian's package of Skein: libcairo2; to build "
                             "Skein again: libcairo2-dev), or let the name end in .svg"));
  }
}

std::string PdfFile(const Picture& picture) {
  std::string file;
  if (!LoadPdfModule().Write(picture, &file)) throw Error("cairo cannot draw the picture: " + file);
  return file;
}

}  // namespace skein
