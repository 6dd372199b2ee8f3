#include "train/backend.h"

#include <utility>

namespace skein {

std::string FusedLimitation(const NetworkShape& shape) {
  if (shape.activation == Activation::kRelu) return "";
  return std::string("network.activation = \"") + Name(shape.activation) + "\"";
}

BackendChoice ChooseBackend(Backend asked, const NetworkShape& shape) {
  if (asked == Backend::kLibTorch) return {Backend::kLibTorch, ""};
  std::string limitation = FusedLimitation(shape);
  if (limitation.empty()) return {Backend::kFused, ""};
  return {Backend::kLibTorch, std::move(limitation)};
}

std::string Describe(const BackendChoice& choice) {
  if (choice.backend == Backend::kFused) return "networks by the fused kernels";
  if (choice.fallback_reason.empty()) return "networks by LibTorch, as asked";
  return "networks by LibTorch, slower: the fused kernels do not know " + choice.fallback_reason;
}

}  // namespace skein
