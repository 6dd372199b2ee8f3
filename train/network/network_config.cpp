// SPDX-License-Identifier: Apache-2.0
#include "train/network/network_config.h"

#include "base/name_in.h"

namespace skein {

const char* Name(Activation activation) { return NameIn(kActivationNames, activation); }

}  // namespace skein
