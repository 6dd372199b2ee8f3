// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "src/plot/picture.h"

namespace skein {

/// The writer of PDF in a shared object of its own, so that nothing else links cairo. A module
/// gives out an interface, and needs no function of the program that loads it; both must come from
/// one build.
class PdfModule {
 public:
  virtual ~PdfModule() = default;
  /// The picture as a PDF file of one page; the same picture is the same file. Returns false, and
  /// the library's reason in `file`, if it cannot be drawn.
  virtual bool Write(const Picture& picture, std::string* file) const = 0;
};

/// The function that a module exports under kPdfModuleEntry; `build` as for LoadModule.
using PdfModuleEntry = const PdfModule*(const char* build);
inline constexpr const char* kPdfModuleEntry = "skein_pdf_module";
inline constexpr const char* kCairoModule = "libskein_cairo.so";

/// Loads the module `file` when it is first asked for, and for good. Throws Error that says how to
/// get it if it is not there, or not of this build.
const PdfModule& LoadPdfModule(const std::string& file = kCairoModule);

/// The picture as a PDF file, by the module. Throws Error without it.
std::string PdfFile(const Picture& picture);

}  // namespace skein
