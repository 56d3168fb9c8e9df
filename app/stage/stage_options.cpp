// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stage/stage_options.h"

#include "app/stage/batch_order.h"
#include "app/stage/past_source.h"
#include "core/log/clock.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace posewire::stage {
namespace {

using usage::Arguments;
using usage::DeclaredOption;

constexpr const char* kGroup = "Servers of a stage";

} // namespace

std::optional<std::string> StageOptions::problem() const {
    if (site.empty()) {
        return "--site is missing: the name of the stage at the servers";
    }
    if (!isName(site)) {
        return "--site: may have letters, digits, - and _, 64 at most";
    }
    for (const auto& [option, text, isGood] :
         {std::tuple("--since: ", since, wallTimeOf(since).has_value()),
          std::tuple("--until: ", until, momentAfter({}, until).has_value())}) {
        if (!text.empty() && !isGood) {
            return option + text + " is no time; write 10:30, 10:30:15 or 2026-11-26T10:30";
        }
    }
    return std::nullopt;
}

tl::expected<std::unique_ptr<log::ByteSource>, log::FileError> openPast(const StageOptions& options,
                                                                        log::IsCancelled isCancelled) {
    if (const auto problem = options.problem()) {
        return tl::unexpected(log::FileError{*problem});
    }
    const auto since = wallTimeOf(options.since);
    if (!since) {
        return tl::unexpected(log::FileError{"--since is missing: when the time begins that is wanted"});
    }
    const auto length = momentAfter(*since, options.until);
    auto source =
        PastSource::open(options.servers, options.site, *since,
                         length ? *since + *length : log::SystemClock().wall(), std::move(isCancelled));
    if (!source) {
        return tl::unexpected(log::FileError{source.error().text});
    }
    return std::move(*source);
}

DeclaredOption addStage(Arguments arguments, StageOptions& options) {
    const auto read = [&options](const std::string& text) {
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find(',', begin), text.size());
            options.servers.addresses.push_back(text.substr(begin, end - begin));
            begin = end + 1;
        }
        return std::string();
    };
    DeclaredOption nats =
        arguments.read("--nats URL[,URL]", read,
                       "servers of NATS: nats://HOST:PORT, tls://HOST:PORT; any of them will "
                       "do");
    nats.group(kGroup);
    const auto add = [&](const std::string& name, std::string& value, const std::string& text) {
        arguments.add(name, value, text).group(kGroup).needs(nats);
    };
    add("--site SITE", options.site, "the stage's name there");
    add("--nats-user NAME", options.servers.user,
        "who we are to them; the password is in the environment, as POSEWIRE_NATS_PASSWORD, or in a file");
    add("--nats-password-file FILE", options.servers.passwordFile, "its first line is the password");
    add("--nats-credentials FILE", options.servers.credentials, "a file of credentials, as nsc writes it");
    add("--nats-nkey FILE", options.servers.nkey, "public key and seed, as nk writes them with -pubout");
    add("--nats-ca FILE", options.servers.authorities, "certificates that sign those of the servers");
    add("--nats-certificate FILE", options.servers.certificate, "our own, if they ask for one");
    add("--nats-key FILE", options.servers.key, "the key of that");
    return nats;
}

DeclaredOption addStageSince(Arguments arguments, StageOptions& options) {
    DeclaredOption nats = addStage(arguments, options);
    arguments
        .add("--since TIME", options.since,
             "what was received from then on, as long as the servers keep it: 10:30, 10:30:15, or "
             "2026-11-26T10:30")
        .group(kGroup)
        .needs(nats);
    return nats;
}

} // namespace posewire::stage
