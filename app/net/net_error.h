// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tl/expected.hpp>

#include <cstdint>
#include <string>

namespace posewire::net {

/// Why a network operation failed.
struct NetError {
    enum class Kind : std::uint8_t {
        PortInUse,
        NoPermission,
        AddressNotHere,
        HostNotFound,
        NotConnected,
        BadEndpoint,
        Other
    };
    Kind kind = Kind::Other;
    std::string text; ///< what, where, what to do: one line for the operator
};

template <typename T>
using NetResult = tl::expected<T, NetError>;

inline tl::unexpected<NetError> netError(NetError::Kind kind, std::string text) {
    return tl::unexpected(NetError{kind, std::move(text)});
}

} // namespace posewire::net
