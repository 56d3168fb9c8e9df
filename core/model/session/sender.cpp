// SPDX-License-Identifier: MIT
#include "core/model/session/sender.h"

namespace posewire::model {

void Sender::takeMalformed(std::int64_t stampNs) {
    CountHistory::Change change;
    change.malformed = 1;
    ++malformed;
    history.add(stampNs, change);
}

} // namespace posewire::model
