// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/property_model.h"
#include "app/gui/receiving_state.h"

#include <QAbstractTableModel>

#include <optional>

namespace posewire::gui {

/// What the window hears: its inputs in the order in which they were added, then the file, if there is one.
/// Named as MVN's Network Streamer names them: protocol, host, port.
class InputModel : public QAbstractTableModel {
    Q_OBJECT

public:
    enum Column : int { kProtocol, kHost, kPort, kState, kRate, kDatagrams, kDropped, kColumnCount };

    using QAbstractTableModel::QAbstractTableModel;

    void refresh(const ReceivingState& receiving);

    /// The input of a row; nothing for the file and outside.
    [[nodiscard]] std::optional<InputAddress> input(int row) const;
    [[nodiscard]] int rowOf(const InputAddress& input) const; ///< -1 where it is not

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    /// An input, or a file where that is not empty.
    struct Row {
        PortState input;
        QString file;
    };

    void fitRows(std::size_t count);
    [[nodiscard]] static QVariant fileData(const QString& file, int column, int role);
    [[nodiscard]] static QString text(const PortState& state, int column);

    std::vector<Row> m_rows;
};

/// "listening", "connected from 10.0.0.5:50123", or what is wrong.
[[nodiscard]] PropertyValue inputState(const PortState& state);

} // namespace posewire::gui
