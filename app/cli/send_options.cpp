// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/send_options.h"

#include "core/wire/type_table.h"

#include <charconv>

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
                "\" is no message type; name some of 01 to 05, 10 to 13 and 20 to 25, or all");
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

} // namespace

tl::expected<std::vector<net::SendTarget>, Complaint> targetsOf(const SendOptions& options) {
    std::vector<net::SendTarget> targets;
    for (const std::string& text : options.to) {
        auto endpoint = net::parseEndpoint(text);
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
    if (auto problem = performer::findProblem(settings)) {
        return tl::unexpected(problem->substr(0, problem->find_last_not_of('.') + 1) +
                              "; see posewire-cli send --help");
    }
    return settings;
}

} // namespace posewire::cli
