// SPDX-License-Identifier: Apache-2.0
#include "train/export/exported_policy.h"

namespace skein {

ExportedPolicy PrepareExport(const RecurrentPolicy& policy, const std::string& who,
                             const std::string& version,
                             const std::shared_ptr<const TermTaskConfig>& terms) {
  ExportedPolicy exported;
  exported.policy = policy.parameters();
  exported.interface = DescribeInterface(*exported.policy, terms, who);
  exported.name = exported.interface.env.task;
  exported.metadata = InterfaceMetadata(exported.interface);
  exported.metadata["version"] = version;
  return exported;
}

}  // namespace skein
