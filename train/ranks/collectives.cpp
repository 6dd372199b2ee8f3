// SPDX-License-Identifier: Apache-2.0
#include "train/ranks/collectives.h"

#include <exception>

namespace skein {
namespace {

constexpr std::size_t kLongestText = 1000;

/// The ranks for whose text `is_named` holds, as "rank 1 (a), rank 2 (b)".
std::string NamesOf(const Ranks& ranks, const std::vector<std::string>& texts,
                    const std::function<bool(const std::string&)>& is_named) {
  std::string names;
  for (int rank = 0; rank < ranks.count(); ++rank) {
    if (!is_named(texts[static_cast<std::size_t>(rank)])) continue;
    names += (names.empty() ? "" : ", ") + ranks.Describe(rank);
  }
  return names;
}

}  // namespace

std::vector<std::string> TextsOfRanks(Ranks& ranks, const std::string& text) {
  return DoForOthers(ranks, [&] {
    std::vector<char> characters(static_cast<std::size_t>(ranks.count()) * kLongestText, '\0');
    const std::size_t own = static_cast<std::size_t>(ranks.rank()) * kLongestText;
    std::copy_n(text.begin(), std::min(text.size(), kLongestText), characters.begin() + own);
    ShareWithAllRanks(ranks, characters);
    std::vector<std::string> texts;
    for (auto begin = characters.begin(); begin != characters.end(); begin += kLongestText) {
      texts.emplace_back(begin, std::find(begin, begin + kLongestText, '\0'));
    }
    return texts;
  });
}

void DoTogether(Ranks& ranks, const std::function<void()>& work) {
  std::exception_ptr failure;
  std::string reason;
  try {
    work();
  } catch (const std::exception& error) {
    failure = std::current_exception();
    reason = std::string("x") + ReasonOf(error);
  }
  const std::vector<std::string> reasons = TextsOfRanks(ranks, reason);
  if (failure != nullptr && ranks.rank() == 0) std::rethrow_exception(failure);
  for (const std::string& theirs : reasons) {
    if (theirs.empty()) continue;
    const auto failed = [](const std::string& text) { return !text.empty(); };
    throw JointError(NamesOf(ranks, reasons, failed) + ": " + theirs.substr(1));
  }
}

void RequireSameOnRanks(Ranks& ranks, const std::string& what, const std::string& text) {
  const std::vector<std::string> texts = TextsOfRanks(ranks, text);
  for (const std::string& theirs : texts) {
    if (theirs == texts[0]) continue;
    throw JointError("ranks differ in " + what + ": rank 0 has " + texts[0] + ", " +
                     NamesOf(ranks, texts, [&](const std::string& of) { return of != texts[0]; }) +
                     " " + theirs);
  }
}

}  // namespace skein
