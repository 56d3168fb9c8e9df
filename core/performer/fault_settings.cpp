// SPDX-License-Identifier: MIT
#include "core/performer/fault_settings.h"

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::performer {
namespace {

constexpr double kLongestDelayMs = 10'000.0;

bool isProbability(double value) {
    return value >= 0.0 && value <= 1.0;
}

std::optional<std::string> findProbabilityProblem(const FaultSettings& settings) {
    const std::array<std::pair<const char*, double>, 5> probabilities{{{"drop", settings.drop},
                                                                       {"duplicate", settings.duplicate},
                                                                       {"reorder", settings.reorder},
                                                                       {"corrupt", settings.corrupt},
                                                                       {"truncate", settings.truncate}}};
    for (const auto& [name, value] : probabilities) {
        if (!isProbability(value)) {
            return std::string("The probability of ") + name + " must be from 0 to 1.";
        }
    }
    const auto& model = settings.gilbertElliott;
    if (model && !(isProbability(model->toBad) && isProbability(model->toGood) &&
                   isProbability(model->passesInGood) && isProbability(model->passesInBad))) {
        return "The four probabilities p, r, k, h of the Gilbert-Elliott model must be from 0 to 1.";
    }
    if (model && settings.drop > 0.0) {
        return "Choose either drop or the Gilbert-Elliott model.";
    }
    return std::nullopt;
}

} // namespace

std::optional<std::string> findProblem(const FaultSettings& settings) {
    if (auto problem = findProbabilityProblem(settings)) {
        return problem;
    }
    if (settings.burst < 1 || settings.burst > 1'000'000) {
        return "A burst is from 1 to 1000000 datagrams long.";
    }
    for (const double milliseconds : {settings.delayMs, settings.jitterMs}) {
        if (!(milliseconds >= 0.0 && milliseconds <= kLongestDelayMs)) {
            return "Delay and jitter must be from 0 to 10000 ms.";
        }
    }
    if (settings.restart && !(settings.restart->atSeconds >= 0.0)) {
        return "A restart needs a time after the start.";
    }
    if (settings.pause && !(settings.pause->atSeconds >= 0.0 && settings.pause->seconds >= 0.0)) {
        return "A pause needs a time after the start and a length.";
    }
    if (settings.reduction && !(settings.reduction->atSeconds >= 0.0 && settings.reduction->step >= 1 &&
                                settings.reduction->step <= 100)) {
        return "A rate is reduced at a time after the start to every 1st to 100th sample.";
    }
    return std::nullopt;
}

} // namespace posewire::performer
