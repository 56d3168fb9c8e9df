// SPDX-License-Identifier: MIT
#include "core/model/session/loss_amount.h"

#include "core/model/text.h"

#include <algorithm>

namespace posewire::model {

std::string lossAmount(std::uint64_t samples, std::uint64_t expected, std::string_view noun) {
    constexpr std::uint64_t kFew = 10;
    const double percent =
        100.0 * static_cast<double>(samples) / static_cast<double>(std::max<std::uint64_t>(1, expected));
    if (samples > kFew && expected > 10 * kFew && percent <= 100) {
        return fixedText(percent, percent < 10 ? 1 : 0) + " %";
    }
    return noun.empty() ? grouped(samples) : counted(samples, noun);
}

} // namespace posewire::model
