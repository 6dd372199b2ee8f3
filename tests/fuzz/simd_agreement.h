// SPDX-License-Identifier: Apache-2.0
// The same inputs through the kernels of every SIMD target, as fuzz targets. A file holds records
// of little-endian words of 32 bits, one per input of an aircraft: a place between the input's
// bounds, or, for the two largest words, infinity and NaN.
#pragma once

#include <string>
#include <vector>

namespace skein {

/// A state with controls, engine power and its command.
std::vector<std::string> PlantSeeds();
/// Without what is left behind the last whole record.
std::string WholePlantRecords(std::string file);
/// One evaluation of the equations of motion and one step. Throws Error on a file that is no whole
/// number of records, or none, and std::logic_error where targets disagree: in whether an aircraft
/// is finite afterwards, or in a number by more than the kernels' tolerance allows.
void ComparePlants(const std::string& file);

/// Observations and state of a recurrent policy.
std::vector<std::string> NetworkSeeds();
std::string WholeNetworkRecords(std::string file);
/// The same of one policy step.
void CompareNetworks(const std::string& file);

}  // namespace skein
