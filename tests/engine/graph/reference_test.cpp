// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "engine/graph/graph.h"

namespace {

using engine::parse_reference;
using engine::Reference;

std::string parsed(const std::string& text) {
  Reference reference;
  std::string error;
  if (!parse_reference(text, reference, error)) return error;
  std::string out = reference.node + " " + reference.output;
  for (const std::string& id : reference.element) out += " [" + id + "]";
  return out;
}

TEST(ParseReference, SplitsNodeOutputAndElement) {
  EXPECT_EQ(parsed("flow"), "flow ");
  EXPECT_EQ(parsed("flow.rms_px"), "flow rms_px");
  EXPECT_EQ(parsed("flow[17]"), "flow  [17]");
  EXPECT_EQ(parsed("flow.flow[take03/17]"), "flow flow [take03] [17]");
  EXPECT_EQ(parsed("stabilise/flow.flow[a.b-c]"), "stabilise/flow flow [a.b-c]");
}

TEST(ParseReference, DropsLeadingZerosOfIds) { EXPECT_EQ(parsed("flow[007/0]"), "flow  [7] [0]"); }

TEST(ParseReference, SaysWhyATextIsNone) {
  EXPECT_EQ(parsed(""), "'' is no reference: it is empty, expected \"node\", \"node.output\" or \"node.output[id]\"");
  EXPECT_EQ(parsed("a b"), "'a b' is no reference: 'a b' is no name of a node");
  EXPECT_EQ(parsed("a.b.c"), "'a.b.c' is no reference: 'b.c' is no name of an output");
  EXPECT_EQ(parsed("a."), "'a.' is no reference: '' is no name of an output");
  EXPECT_EQ(parsed("a[3"), "'a[3' is no reference: ']' is missing at its end");
  EXPECT_EQ(parsed("a[3].b"), "'a[3].b' is no reference: ']' is missing at its end");
  EXPECT_EQ(parsed("/a"), "'/a' is no reference: '' is no name of a node");
  EXPECT_EQ(parsed("a[]"),
            "'a[]' is no reference: '' is no element id (ids are made of letters, digits, '_', '-' and '.', and 3-5 is "
            "a range)");
  EXPECT_EQ(parsed("a[../b]"),
            "'a[../b]' is no reference: '..' is no element id (ids are made of letters, digits, '_', '-' and '.', and "
            "3-5 is a range)");
}

}  // namespace
