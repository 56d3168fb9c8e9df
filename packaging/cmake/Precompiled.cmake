# SPDX-License-Identifier: GPL-3.0-or-later
# The kinds of precompiled headers. Only headers of others are here: what changes with our own work would make every unit new.
# And only those that many units include: each unit reads all of its kind, and the whole of Qt Widgets costs it 0.5 s.
set(standard <algorithm> <array> <chrono> <cmath> <cstddef> <cstdint> <deque> <functional> <map> <memory> <optional>
  <span> <string> <string_view> <tuple> <type_traits> <utility> <variant> <vector> <tl/expected.hpp>)

posewire_precompile(core HEADERS ${standard} LIBRARIES tl::expected)
posewire_precompile(body HEADERS ${standard} <Eigen/Core> <Eigen/Geometry> LIBRARIES tl::expected Eigen3::Eigen)
if(POSEWIRE_BUILD_RENDER OR POSEWIRE_BUILD_APP)
  find_package(glm REQUIRED)
  posewire_precompile(render HEADERS ${standard} <glm/glm.hpp> <glm/gtc/quaternion.hpp> LIBRARIES tl::expected glm::glm)
endif()
set(network <QCoreApplication> <QHostAddress> <QNetworkInterface> <QString> <QTcpServer> <QTcpSocket> <QTimer> <QUdpSocket>)
set(window <QAction> <QApplication> <QClipboard> <QComboBox> <QDateTime> <QDialog> <QDialogButtonBox> <QDockWidget>
  <QFileDialog> <QGridLayout> <QHBoxLayout> <QHeaderView> <QItemSelectionModel> <QJsonArray> <QJsonObject> <QKeyEvent>
  <QLabel> <QLineEdit> <QMainWindow> <QMenu> <QPainter> <QPushButton> <QScreen> <QScrollBar> <QSettings> <QShortcut>
  <QSplitter> <QString> <QStringList> <QStyledItemDelegate> <QTableView> <QTimer> <QToolButton> <QTreeView> <QVBoxLayout>
  <QWidget>)
if(POSEWIRE_BUILD_APP)
  find_package(Qt6 6.4 REQUIRED COMPONENTS Core Network)
  posewire_precompile(network HEADERS ${standard} ${network} LIBRARIES tl::expected Qt6::Network)
endif()
if(POSEWIRE_BUILD_WINDOW)
  find_package(Qt6 6.4 REQUIRED COMPONENTS Widgets)
  posewire_precompile(window HEADERS ${standard} ${window} LIBRARIES tl::expected Qt6::Widgets)
endif()
if(POSEWIRE_BUILD_TESTS)
  posewire_precompile(test HEADERS ${standard} <gmock/gmock.h> <gtest/gtest.h> LIBRARIES tl::expected GTest::gmock)
  if(POSEWIRE_BUILD_APP)
    posewire_precompile(network_test HEADERS ${standard} <gmock/gmock.h> <gtest/gtest.h> ${network}
      LIBRARIES tl::expected GTest::gmock Qt6::Network)
  endif()
  if(POSEWIRE_BUILD_WINDOW)
    posewire_precompile(window_test HEADERS ${standard} <gmock/gmock.h> <gtest/gtest.h> ${window}
      LIBRARIES tl::expected GTest::gmock Qt6::Widgets)
  endif()
endif()
