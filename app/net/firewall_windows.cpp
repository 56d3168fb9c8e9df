// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/connection_help.h"

#include <windows.h>

namespace posewire::net {

/// Windows' own firewall is on unless a profile is switched off; rules are not read.
std::optional<Firewall> findFirewall() {
    constexpr const wchar_t* kPolicy =
        L"SYSTEM\\CurrentControlSet\\Services\\SharedAccess\\Parameters\\FirewallPolicy\\";
    bool isOn = false;
    for (const wchar_t* profile : {L"StandardProfile", L"PublicProfile", L"DomainProfile"}) {
        DWORD enabled = 1;
        DWORD size = sizeof enabled;
        const LSTATUS read = ::RegGetValueW(HKEY_LOCAL_MACHINE, (std::wstring(kPolicy) + profile).c_str(),
                                            L"EnableFirewall", RRF_RT_REG_DWORD, nullptr, &enabled, &size);
        isOn = isOn || (read == ERROR_SUCCESS && enabled != 0);
    }
    if (!isOn) {
        return std::nullopt;
    }
    return Firewall{"Windows Firewall",
                    "netsh advfirewall firewall add rule name=Posewire dir=in action=allow "
                    "protocol=udp localport=PORT"};
}

} // namespace posewire::net
