// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/send.h"

#include "core/wire/type_table.h"

#include <charconv>
#include <cmath>

namespace posewire::cli {
namespace {

tl::expected<std::vector<std::uint8_t>, Complaint> typesOf(std::string_view list) {
    std::vector<std::uint8_t> types;
    while (list != "all" && !list.empty()) {
        const std::string_view word = list.substr(0, list.find(','));
        std::uint8_t type = 0;
        const char* end = word.data() + word.size();
        const bool isNumber = std::from_chars(word.data(), end, type).ptr == end && !word.empty();
        if (!isNumber || wire::findType(type) == nullptr) {
            return tl::unexpected(
                "--types: \"" + std::string(word) +
                "\" is not a message type; choose from 01 to 05, 10 to 13 and 20 to 25, or all");
        }
        types.push_back(type);
        list.remove_prefix(std::min(list.size(), word.size() + 1));
    }
    return types;
}

tl::expected<performer::Revision, Complaint> revisionOf(const std::string& name) {
    constexpr std::string_view letters = "EJKN";
    const std::size_t place = name.size() == 1 ? letters.find(name) : std::string_view::npos;
    if (place == std::string_view::npos) {
        return tl::unexpected("--revision: \"" + name + "\" is not known; choose E, J, K or N");
    }
    return static_cast<performer::Revision>(place);
}

/// Above all that is asked for: the highest counter.
constexpr double kMost = 4294967295.0;

/// "1.5:2" with ':' as two numbers, from 0 to kMost.
std::optional<std::vector<double>> numbersIn(std::string_view text, char separator) {
    std::vector<double> numbers;
    while (true) {
        const std::size_t end = std::min(text.find(separator), text.size());
        double number = 0.0;
        const char* last = text.data() + end;
        const auto parsed = std::from_chars(text.data(), last, number);
        const bool isSensible = number >= 0.0 && number <= kMost; // false for what is not a number
        if (end == 0 || parsed.ec != std::errc{} || parsed.ptr != last || !isSensible) {
            return std::nullopt;
        }
        numbers.push_back(number);
        if (end == text.size()) {
            return numbers;
        }
        text.remove_prefix(end + 1);
    }
}

tl::unexpected<Complaint> misread(const std::string& option, const std::string& text,
                                  const std::string& expected) {
    return tl::unexpected(option + ": \"" + text + "\" cannot be read; give " + expected);
}

bool isWhole(double value, double most) {
    return value >= 0.0 && value <= most && value == std::floor(value);
}

tl::expected<void, Complaint> readGilbertElliott(const std::string& text, performer::FaultSettings& faults) {
    if (text.empty()) {
        return {};
    }
    const auto numbers = numbersIn(text, ',');
    if (!numbers || (numbers->size() != 2 && numbers->size() != 4)) {
        return misread("--gilbert-elliott", text, "p,r or p,r,k,h, such as 0.01,0.2 or 0.01,0.2,1,0");
    }
    faults.gilbertElliott = performer::GilbertElliott{(*numbers)[0], (*numbers)[1]};
    if (numbers->size() == 4) {
        faults.gilbertElliott->passesInGood = (*numbers)[2];
        faults.gilbertElliott->passesInBad = (*numbers)[3];
    }
    return {};
}

tl::expected<void, Complaint> readMoments(const SendOptions& options, performer::FaultSettings& faults) {
    if (!options.restart.empty()) {
        const auto numbers = numbersIn(options.restart, ':');
        const bool isGood =
            numbers && numbers->size() <= 2 && (numbers->size() == 1 || isWhole(numbers->back(), kMost));
        if (!isGood) {
            return misread("--restart-at", options.restart,
                           "SECONDS or SECONDS:SAMPLE, each from 0 to 4294967295, such as 2.5:100");
        }
        const auto sample = numbers->size() == 2 ? static_cast<std::uint32_t>(numbers->back())
                                                 : options.performer.firstSample;
        faults.restart = performer::FaultSettings::Restart{numbers->front(), sample};
    }
    if (!options.pause.empty()) {
        const auto numbers = numbersIn(options.pause, ':');
        if (!numbers || numbers->size() != 2) {
            return misread("--pause-at", options.pause, "START:LENGTH in seconds from 0 up, such as 2:0.5");
        }
        faults.pause = performer::FaultSettings::Pause{numbers->front(), numbers->back()};
    }
    if (!options.reduction.empty()) {
        const auto numbers = numbersIn(options.reduction, ':');
        if (!numbers || numbers->size() != 2 || !isWhole(numbers->back(), 1e9)) {
            return misread("--reduce-at", options.reduction,
                           "SECONDS:K to send every Kth sample from then on, K from 1 to 100, such as 2:4");
        }
        faults.reduction = performer::FaultSettings::Reduction{numbers->front(),
                                                               static_cast<std::uint32_t>(numbers->back())};
    }
    return {};
}

Complaint withoutStop(const std::string& problem) {
    return problem.substr(0, problem.find_last_not_of('.') + 1) + "; see posewire-cli send --help";
}

} // namespace

tl::expected<std::vector<net::SendTarget>, Complaint> targetsOf(const SendOptions& options) {
    std::vector<net::SendTarget> targets;
    for (const std::string& text : options.to) {
        auto endpoint = net::parseTarget(text);
        if (!endpoint) {
            return tl::unexpected("--to: " + endpoint.error().text);
        }
        using Transport = net::SendTarget::Transport;
        targets.push_back({std::move(*endpoint), options.overTcp ? Transport::Tcp : Transport::Udp});
    }
    return targets;
}

tl::expected<performer::PerformerSettings, Complaint> performerOf(const SendOptions& options) {
    performer::PerformerSettings settings = options.performer;
    auto types = typesOf(options.types);
    if (!types) {
        return tl::unexpected(types.error());
    }
    const auto revision = revisionOf(options.revision);
    if (!revision) {
        return tl::unexpected(revision.error());
    }
    settings.types = std::move(*types);
    settings.revision = *revision;
    settings.isYUp = options.up == "y";
    settings.asOnPaper = options.forms == "paper";
    if (auto problem = performer::findProblem(settings)) {
        return tl::unexpected(withoutStop(*problem));
    }
    return settings;
}

tl::expected<performer::FaultSettings, Complaint> faultsOf(const SendOptions& options) {
    performer::FaultSettings faults = options.faults;
    faults.isRecorded = !options.file.empty();
    faults.seed = options.performer.seed;
    faults.rateHz = options.performer.rateHz;
    if (!options.fault.kind.empty()) {
        faults.content = options.fault;
    }
    if (const auto read = readGilbertElliott(options.gilbertElliott, faults); !read) {
        return tl::unexpected(read.error());
    }
    if (const auto read = readMoments(options, faults); !read) {
        return tl::unexpected(read.error());
    }
    if (const auto problem = performer::findProblem(faults)) {
        return tl::unexpected(withoutStop(*problem));
    }
    return faults;
}

} // namespace posewire::cli
