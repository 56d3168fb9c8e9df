// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/outlets/metrics.h"

namespace posewire::outlets {

struct Metrics::Parts {};

Metrics::~Metrics() = default;

net::NetResult<std::unique_ptr<Metrics>> Metrics::serve(const std::string& /*place*/,
                                                        std::string /*version*/) {
    return net::netError(net::NetError::Kind::Other,
                         "metrics are not served on Windows; use Posewire on Linux, or leave the option out");
}

void Metrics::update(const model::SessionView& /*session*/, const OwnFigures& /*own*/) {}

} // namespace posewire::outlets
