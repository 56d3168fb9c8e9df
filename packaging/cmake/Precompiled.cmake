# SPDX-License-Identifier: GPL-3.0-or-later
# The kinds of precompiled headers. Only headers of others stand here: what changes with our own work would make every unit new.
set(standard <algorithm> <array> <chrono> <cmath> <cstddef> <cstdint> <deque> <functional> <map> <memory> <optional>
  <span> <string> <string_view> <tuple> <type_traits> <utility> <variant> <vector> <tl/expected.hpp>)

posewire_precompile(core HEADERS ${standard} LIBRARIES tl::expected)
posewire_precompile(body HEADERS ${standard} <Eigen/Core> <Eigen/Geometry> LIBRARIES tl::expected Eigen3::Eigen)
if(POSEWIRE_BUILD_RENDER)
  find_package(glm REQUIRED)
  posewire_precompile(render HEADERS ${standard} <glm/glm.hpp> <glm/gtc/quaternion.hpp> LIBRARIES tl::expected glm::glm)
endif()
if(POSEWIRE_BUILD_APP)
  find_package(Qt6 6.4 REQUIRED COMPONENTS Core Network Widgets)
  posewire_precompile(network HEADERS ${standard} <QtNetwork/QtNetwork> LIBRARIES tl::expected Qt6::Network)
  posewire_precompile(window HEADERS ${standard} <QtWidgets/QtWidgets> LIBRARIES tl::expected Qt6::Widgets)
endif()
if(POSEWIRE_BUILD_TESTS)
  posewire_precompile(test HEADERS ${standard} <gmock/gmock.h> <gtest/gtest.h> LIBRARIES tl::expected GTest::gmock)
  if(POSEWIRE_BUILD_APP)
    posewire_precompile(network_test HEADERS ${standard} <gmock/gmock.h> <gtest/gtest.h> <QtNetwork/QtNetwork>
      LIBRARIES tl::expected GTest::gmock Qt6::Network)
    posewire_precompile(window_test HEADERS ${standard} <gmock/gmock.h> <gtest/gtest.h> <QtWidgets/QtWidgets>
      LIBRARIES tl::expected GTest::gmock Qt6::Widgets)
  endif()
endif()
