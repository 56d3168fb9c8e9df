// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"
#include "app/gui/receiving_state.h"

namespace posewire::gui {

/// The hosts that everything is forwarded to, in the order in which they were added. Each is switched on and
/// off by its box.
class RelayModel : public TableModel<RelayState> {
    Q_OBJECT

public:
    enum Column : int { kHost, kPort, kState, kSent, kRefused, kSkipped, kColumnCount };

    explicit RelayModel(QObject* parent = nullptr);

    void refresh(const std::vector<RelayState>& relays) { setRows(relays); }

    [[nodiscard]] bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;

signals:
    /// The operator has switched one; the row changes with the next refresh().
    void switched(int row, bool isOn);
};

/// "forwarding", "off", or why not.
[[nodiscard]] PropertyValue relayStage(const RelayState& relay);

} // namespace posewire::gui
