// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/options.h"
#include "app/net/addresses.h"

#include <QWidget>

#include <vector>

class QGridLayout;
class QLabel;
class QToolButton;

namespace posewire::gui {

/// What to type into MVN so that it reaches a input: host, port and protocol, in MVN's words, to be copied.
class SenderSettings final : public QWidget {
    Q_OBJECT

public:
    explicit SenderSettings(QWidget* parent = nullptr);

    void showFor(const InputAddress& input, const std::vector<net::LocalAddress>& addresses);

    /// The hosts that are shown, the best first.
    [[nodiscard]] QStringList hosts() const;

signals:
    void copyRequested(const QString& text);

private:
    struct HostRow {
        QLabel* host;
        QLabel* interface;
        QToolButton* copy;
    };

    void addHostRow();
    void setHosts(const std::vector<net::LocalAddress>& hosts);

    QGridLayout* m_grid;
    QLabel* m_title;
    QLabel* m_portTitle;
    QLabel* m_port;
    QLabel* m_protocolTitle;
    QLabel* m_protocol;
    std::vector<HostRow> m_rows;
};

/// The addresses that reach an input: the one it listens at, else those of this computer; its groups where it
/// has any.
[[nodiscard]] std::vector<net::LocalAddress> hostsFor(const InputAddress& input,
                                                      const std::vector<net::LocalAddress>& addresses);

} // namespace posewire::gui
