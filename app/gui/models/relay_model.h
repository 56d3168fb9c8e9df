// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/property_model.h"
#include "app/gui/receiving_state.h"

#include <QAbstractTableModel>

namespace posewire::gui {

/// The hosts that everything is forwarded to, in the order in which they were added. Each is switched on and
/// off by its box.
class RelayModel : public QAbstractTableModel {
    Q_OBJECT

public:
    enum Column : int { kHost, kPort, kState, kSent, kRefused, kSkipped, kColumnCount };

    using QAbstractTableModel::QAbstractTableModel;

    void refresh(const std::vector<RelayState>& relays);

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

signals:
    /// The operator has switched one; the row changes with the next refresh().
    void switched(int row, bool isOn);

private:
    [[nodiscard]] static QString text(const RelayState& relay, int column);

    std::vector<RelayState> m_relays;
};

/// "forwarding", "off", or why not.
[[nodiscard]] PropertyValue relayStage(const RelayState& relay);

} // namespace posewire::gui
