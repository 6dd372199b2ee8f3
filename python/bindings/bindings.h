// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <initializer_list>
#include <vector>

namespace skein {

/// What each part adds to the extension module `_skein`. The package's modules wrap it: what they
/// document is the API, and this is not.
void BindConfiguration(nanobind::module_& module);
void BindEnvironment(nanobind::module_& module);
void BindAgents(nanobind::module_& module);
void BindEvaluation(nanobind::module_& module);
void BindFlightDynamics(nanobind::module_& module);
void BindTraining(nanobind::module_& module);
void BindMeasures(nanobind::module_& module);

/// Arrays of NumPy or of whatever speaks DLPack, used in place if type and layout fit.
template <typename T>
using Row = nanobind::ndarray<T, nanobind::ndim<1>, nanobind::c_contig, nanobind::device::cpu>;
template <typename T>
using Rows = nanobind::ndarray<T, nanobind::ndim<2>, nanobind::c_contig, nanobind::device::cpu>;

/// `values` as an array of NumPy that owns them.
template <typename T>
nanobind::ndarray<nanobind::numpy, T> ToNumpy(std::vector<T> values,
                                              std::initializer_list<std::size_t> shape) {
  auto* const owned = new std::vector<T>(std::move(values));
  nanobind::capsule owner(
      owned, [](void* vector) noexcept { delete static_cast<std::vector<T>*>(vector); });
  return {owned->data(), shape, owner};
}

}  // namespace skein
