// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/rule_shares.h"

#include <calotte/generators.h>
#include <calotte/widths.h>

#include <doctest/doctest.h>

#include <vector>

using namespace calotte;
using namespace calotte::tools;

TEST_CASE("the rules of a minimum have shares of the area and of the cells") {
  const Points3 line = from_lonlat(Points2{{-10, 10}, {0, 0}});
  const WidthRules rules{
      .widths = Widths::minimum({200.0, Widths::by_latitude({{{-90, 400}, {0, 400}, {0.001, 50}}}),
                                 Widths::around({line}, 10, 200)}),
      .names = {"width", "by-latitude", "around"}};
  const auto shares_of = [](const WidthRules& of, const Surface& surface) {
    return rule_shares(of, surface, density_of(sampled(of.widths)));
  };
  const std::vector<RuleShare> shares = shares_of(rules, Surface::sphere());
  REQUIRE(shares.size() == 3);
  CHECK(shares[1].name == "by-latitude");
  CHECK(shares[1].area == doctest::Approx(0.5).epsilon(0.02));
  CHECK(shares[0].area + shares[1].area + shares[2].area == doctest::Approx(1));
  CHECK(shares[0].cells + shares[1].cells + shares[2].cells == doctest::Approx(1));
  // The south has half of the area, of cells four times as wide.
  CHECK(shares[0].cells / shares[1].cells ==
        doctest::Approx(shares[0].area / shares[1].area / 16).epsilon(0.02));
  const Surface south = channel(-1.5707963267948966, -0.5);
  CHECK(shares_of(rules, south)[0].area == doctest::Approx(1));
}
