// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read_text.h"
#include "support/clouds.h"
#include "support/errors.h"
#include "support/files.h"
#include "support/parts.h"
#include "support/random.h"

#include <calotte/boundary.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <vector>

// SCHISM, ADCIRC, SMS and Gmsh: triangles with depths and lists of the boundary.

using namespace calotte;
using namespace calotte::test;

namespace {

/// The sphere without a cap, and without an island; each site is in a triangle.
Mesh sea_with_island() {
  Points3 points = fibonacci_sphere(800);
  const auto is_sea = [](const Eigen::Vector3d& x) { return x.z() < 0.7 && !(x.x() > 0.93); };
  const Mesh whole = delaunay(points);
  const Mesh part = part_of(whole, [&](std::int64_t t) {
    for (const std::int32_t site : whole.triangles.col(t))
      if (!is_sea(whole.points.col(site)))
        return false;
    return true;
  });
  // without_ears() removes the sites without triangles.
  return *without_ears({.mesh = part}).file.mesh;
}

struct CoastalFormat {
  std::string name;
  Format format;
  bool depth;
};
const std::vector<CoastalFormat> coastal_formats{{"hgrid.gr3", Format::schism, true},
                                                 {"fort.14", Format::adcirc, true},
                                                 {"mesh.2dm", Format::sms, true},
                                                 {"mesh.msh", Format::gmsh, false}};

const MeshField* field_of(const MeshFile& file, const std::string& name) {
  const auto found = std::ranges::find(file.fields, name, &MeshField::name);
  return found == file.fields.end() ? nullptr : &*found;
}

std::vector<std::string> rules_violated(const std::string& path) {
  std::vector<std::string> texts;
  for (const Deviation& deviation : check_file(path, read_mesh_file(path)))
    texts.push_back(deviation.text);
  return texts;
}

/// Four triangles around the hole 4 5 6 of the triangle 1 2 3, and two more.
std::string ring_grid(const std::string& boundary) {
  return "a ring\n6 6\n"
         "1 0 0 10\n2 10 0 20\n3 5 10 30\n4 4 2 -1\n5 6 2 50\n6 5 5 60\n"
         "1 3 1 2 5\n2 3 1 5 4\n3 3 2 3 6\n4 3 2 6 5\n5 3 3 1 4\n6 3 3 4 6\n" +
         boundary;
}
const std::string closed_lists = "0\n0\n2\n7\n4 20\n1\n2\n3\n1\n3 21\n4\n6\n5\n";

} // namespace

TEST_CASE("triangles, depths and the open boundary come back, and the rules of the models hold") {
  const Scratch scratch;
  const Mesh mesh = sea_with_island();
  DoubleVector depth(mesh.points.cols());
  for (Eigen::Index i = 0; i < depth.size(); ++i)
    depth[i] = 0.1 + 7 * static_cast<double>(i) - 100;
  const Surface east = box(0, 0.4, 1.5, 1.4);
  for (const Ids& open :
       {Ids(), boundary_sites(mesh, east), boundary_sites(mesh, box(-3.1, 0.4, 3.1, 1.5)),
        Ids(Ids::LinSpaced(mesh.points.cols(), 0, int(mesh.points.cols()) - 1))})
    for (const CoastalFormat& kind : coastal_formats) {
      CAPTURE(kind.name);
      CAPTURE(open.size());
      const std::string path = scratch / kind.name;
      write(path, mesh,
            {.format = kind.format,
             .site_depth = kind.depth ? depth : DoubleVector(),
             .open_sites = open});
      const MeshFile file = read_mesh_file(path);
      CHECK((file.mesh->points - mesh.points).cwiseAbs().maxCoeff() < 1e-15);
      CHECK(file.mesh->triangles == mesh.triangles);
      CHECK(rules_violated(path) == std::vector<std::string>{});
      if (kind.depth)
        CHECK(field_of(file, "depth")->values == depth);
      if (kind.format == Format::sms) // which does not say what is open
        continue;
      const MeshField* const flags = field_of(file, "open");
      CHECK((flags != nullptr) == (open.size() > 0));
      const IdLists loops = boundary_loops(mesh);
      const std::set<std::int32_t> boundary(loops.items.begin(), loops.items.end());
      const std::set<std::int32_t> wanted(open.begin(), open.end());
      for (std::int32_t i = 0; flags != nullptr && i < mesh.points.cols(); ++i)
        CHECK((flags->values[i] == 1) == (boundary.contains(i) && wanted.contains(i)));
    }
}

TEST_CASE(
    "depths and open boundaries go from format to format, and along when cells are renumbered") {
  const Scratch scratch;
  const Mesh mesh = sea_with_island();
  const DoubleVector depth = DoubleVector::LinSpaced(mesh.points.cols(), 1, 1000);
  write(scratch / "hgrid.gr3", mesh,
        {.site_depth = depth, .open_sites = boundary_sites(mesh, box(0, 0.4, 1.5, 1.4))});
  const MeshFile first = read_mesh_file(scratch / "hgrid.gr3");
  CHECK(write(scratch / "fort.14", first).dropped.empty());
  CHECK(write(scratch / "mesh.vtp", first).dropped.empty());
  CHECK(write(scratch / "mesh.2dm", read_mesh_file(scratch / "mesh.vtp")).dropped.empty());
  CHECK(write(scratch / "again.gr3", read_mesh_file(scratch / "fort.14"),
              {.numbering = Numbering::curve})
            .dropped.empty());
  CHECK(rules_violated(scratch / "again.gr3").empty());
  const MeshFile again = read_mesh_file(scratch / "again.gr3");
  const Mesh renumbering = [&] {
    Mesh own = mesh;
    own.site_of_input.resize(static_cast<std::size_t>(mesh.points.cols()));
    for (std::size_t i = 0; i < own.site_of_input.size(); ++i)
      own.site_of_input[i] = static_cast<std::int32_t>(i);
    return renumbered(own, Numbering::curve);
  }();
  for (std::size_t i = 0; i < renumbering.site_of_input.size(); ++i) {
    const std::int32_t now = renumbering.site_of_input[i];
    CHECK(field_of(again, "depth")->values[now] == depth[static_cast<Eigen::Index>(i)]);
    CHECK(field_of(again, "open")->values[now] ==
          field_of(first, "open")->values[static_cast<Eigen::Index>(i)]);
  }
  CHECK(field_of(read_mesh_file(scratch / "mesh.2dm"), "depth")->values == depth);
  // Fields by hand do the same.
  write(scratch / "by-hand.gr3", mesh,
        {.fields = {{.name = "depth", .values = depth}, *field_of(first, "open")}});
  CHECK(read_file(scratch / "by-hand.gr3") == read_file(scratch / "hgrid.gr3"));
  CHECK(refusal_of([&] {
          write(scratch / "x.gr3", mesh, {.fields = {{.name = "salt", .values = depth}}});
        }).find("SCHISM holds no fields") != std::string::npos);
}

TEST_CASE("the largest land beyond a loop is the mainland, and islands follow it") {
  const Scratch scratch;
  write(scratch / "fort.14", read_text(scratch / "ring.14", ring_grid(closed_lists)));
  const std::string text = read_file(scratch / "fort.14");
  CHECK(text.ends_with("2 = number of land boundaries\n7 = number of nodes of land boundaries\n"
                       "4 20\n1\n2\n3\n1\n3 21\n4\n6\n5\n"));
  write(scratch / "hgrid.gr3", read_mesh_file(scratch / "ring.14"));
  CHECK(read_file(scratch / "hgrid.gr3")
            .ends_with("3 = number of land boundaries\n8 = number of nodes of land boundaries\n"
                       "3 0\n1\n2\n3\n2 0\n3\n1\n3 1\n4\n6\n5\n"));
  MeshFile file = read_mesh_file(scratch / "ring.14");
  write(scratch / "fort.14", file, {.open_sites = Ids{{1, 2}}});
  CHECK(read_file(scratch / "fort.14")
            .ends_with("1 = number of open boundaries\n2 = number of nodes of open boundaries\n"
                       "2 0\n2\n3\n2 = number of land boundaries\n6 = number of nodes of land "
                       "boundaries\n3 20\n3\n1\n2\n3 21\n4\n6\n5\n"));
}

TEST_CASE("check names the rule of the model that a file violates") {
  const Scratch scratch;
  const auto first_failure = [&](const std::string& name, const std::string& boundary) {
    write_text(scratch / name, ring_grid(boundary));
    const std::vector<std::string> texts = rules_violated(scratch / name);
    return texts.empty() ? "" : texts.front();
  };
  CHECK(first_failure("a.14", closed_lists) == "");
  CHECK(first_failure("a.gr3", closed_lists) == "");
  const auto both = [&](const std::string& boundary) {
    CHECK(first_failure("a.gr3", boundary) == first_failure("a.14", boundary));
    return first_failure("a.14", boundary);
  };
  CHECK(both("0\n0\n1\n4\n4 20\n1\n2\n3\n1\n") ==
        "boundary: each outer edge is in one list (3 times); that from node 4 to node 6 is in 0");
  CHECK(both("0\n0\n2\n8\n4 20\n1\n2\n3\n1\n3 21\n4\n6\n5\n") ==
        "land boundary: the number of nodes is that of the lists; the file states 8, its lists "
        "have 7");
  CHECK(both("1\n3\n2 0\n2\n3\n2\n6\n3 20\n3\n1\n2\n3 21\n4\n6\n5\n") ==
        "open boundary: the number of nodes is that of the lists; the file states 3, its lists "
        "have 2");
  CHECK(both("0\n0\n2\n7\n4 20\n1\n2\n4\n1\n3 21\n4\n6\n5\n")
            .starts_with("boundary: each outer edge is in one list (2 times); that from node 2"));
  CHECK(both("0\n0\n2\n8\n5 20\n1\n2\n3\n1\n2\n3 21\n4\n6\n5\n") ==
        "boundary: each outer edge is in one list; that from node 1 to node 2 is in 2");
  CHECK(both("0\n0\n2\n4\n1 20\n1\n3 21\n4\n6\n5\n")
            .starts_with("boundary: each outer edge is in one list (3 times)"));
  const std::string left = "0\n0\n2\n7\n4 20\n1\n2\n3\n1\n3 21\n4\n5\n6\n";
  CHECK(first_failure("a.gr3", left) == ""); // SCHISM takes both
  CHECK(first_failure("a.14", left) == "land boundary: land is to the right of a list (3 times); "
                                       "that at line 24 has it to the left, from node 4 to node 5");
  const std::string looped = "1\n4\n4 0\n1\n2\n3\n1\n1\n3\n3 21\n4\n6\n5\n";
  CHECK(first_failure("a.14", looped) == "");
  CHECK(first_failure("a.gr3", looped) ==
        "open boundary: an open list does not end where it starts; that at line 17 does");
  CHECK(first_failure("a.14", "") == "boundary: the file has lists of its nodes; they are missing");
  CHECK(first_failure("hgrid.gr3", "") ==
        "boundary: the file has lists of its nodes; they are missing");
  CHECK(first_failure("other.gr3", "") == ""); // such as drag.gr3
  CHECK(first_failure("hgrid.ll", "") == "");
  // A dike inside the mesh has nodes on both sides, and other lists then need not be complete.
  CHECK(first_failure("a.14", "0\n0\n1\n4\n2 24\n4 6 1 1 1\n6 5 1 1 1\n") == "");
}

TEST_CASE("a boundary that passes a node twice, and a node in no triangle, are refused and found") {
  const Scratch scratch;
  const std::string twice = "x\n2 5\n1 0 0 1\n2 1 -1 1\n3 1 1 1\n4 -1 1 1\n5 -1 -1 1\n"
                            "1 3 1 2 3\n2 3 1 4 5\n",
                    lists = "0\n0\n2\n6\n3 1\n1\n2\n3\n3 1\n1\n4\n5\n";
  const MeshFile file = read_text(scratch / "a.gr3", twice + lists);
  CHECK(rules_violated(scratch / "a.gr3") ==
        std::vector<std::string>{"nodes: the boundary passes each once; it passes node 1 again"});
  CHECK(refusal_of([&] { write(scratch / "b.14", file); }) ==
        (scratch / "b.14") + ": the boundary passes site 0 more than once, which ADCIRC refuses; "
                             "widen the sea there, as calotte coast does");
  const std::string lone = "x\n1 4\n1 0 0 1\n2 1 -1 1\n3 1 1 1\n4 5 5 1\n1 3 1 2 3\n";
  const MeshFile unused =
      read_text(scratch / "a.gr3", lone + "0\n0\n2\n5\n3 0\n1\n2\n3\n2 0\n3\n1\n");
  CHECK(rules_violated(scratch / "a.gr3") ==
        std::vector<std::string>{"nodes: each is in a triangle; node 4 is in none"});
  CHECK(refusal_of([&] { write(scratch / "b.gr3", unused); }) ==
        (scratch / "b.gr3") +
            ": site 3 is in no triangle, which SCHISM refuses; leave the point out");
  CHECK(scratch.files() == 1);
  write(scratch / "c.2dm", file); // SMS takes it
  CHECK(rules_violated(scratch / "c.2dm").empty());
  const Mesh pole = part_of(delaunay(octahedron()), [](std::int64_t t) { return t != 7; });
  CHECK(refusal_of([&] {
          write(scratch / "b.gr3", pole);
        }).ends_with("is the south pole, which SCHISM refuses; move it"));
}

TEST_CASE("depths and sites of the open boundary that do not fit are refused") {
  const Scratch scratch;
  const Mesh mesh = sea_with_island();
  const auto refusal = [&](const WriteOptions& options) {
    return refusal_of([&] { write(scratch / "fort.14", mesh, options); });
  };
  DoubleVector depth = DoubleVector::Zero(mesh.points.cols());
  depth[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal({.site_depth = depth})
            .ends_with("the depth is nan at site 3; give a number of metres everywhere"));
  CHECK(refusal({.site_depth = DoubleVector::Zero(3)}).find("has 3 values") != std::string::npos);
  CHECK(refusal({.open_sites = Ids{{0, -1}}}).find("-1 is none of the ") != std::string::npos);
  CHECK(scratch.files() == 0);
}

TEST_CASE("files of other programs: remarks, blanks, types that are left out, any order") {
  const Scratch scratch;
  const MeshFile file =
      read_text(scratch / "a.gr3",
                ring_grid("1 = Number of open boundaries\n2 = nodes\n2 = of the first\n2 ! a\n3\n"
                          "2 ! land\n6\n3 0 = Number of nodes\n3\n1\n2\n\n3 1\n4\n6\n5\n"));
  CHECK(field_of(file, "open")->values == DoubleVector{{0, 1, 1, 0, 0, 0}});
  CHECK(field_of(file, "depth")->values == DoubleVector{{10, 20, 30, -1, 50, 60}});
  CHECK(rules_violated(scratch / "a.gr3").empty());
  const MeshFile sms = read_text(
      scratch / "a.2dm", "MESH2D\nMESHNAME \"a\"\nND 1 0 0 -5\nND 2 10 0 0\nND 3 5 10 2\n"
                         "E3T 1 1 2 3 1\nNS 1 2\nNS  -3 1\nNS 3 -1 17 \"south\"\nBEGPARAMDEF\n");
  CHECK(field_of(sms, "depth")->values == DoubleVector{{5, 0, -2}});
  CHECK(rules_violated(scratch / "a.2dm").empty());
  const std::string square = "MESH2D\nND 1 0 0 0\nND 2 10 0 0\nND 3 10 10 2\nND 4 0 10 2\n"
                             "E3T 1 1 2 3 1\nE3T 2 1 3 4 1\nNS 1 -3\nNS 4 ";
  write_text(scratch / "b.2dm", square + "-1\n"); // within the mesh, and a part of its boundary
  CHECK(rules_violated(scratch / "b.2dm").empty());
  write_text(scratch / "b.2dm", square + "-2\n");
  CHECK(rules_violated(scratch / "b.2dm") ==
        std::vector<std::string>{"land boundary: consecutive nodes join an edge; in the list at "
                                 "line 9, node 4 and node 2 do not"});
}

TEST_CASE("Gmsh: lines of the group open are open, in versions 2 and 4") {
  const Scratch scratch;
  const std::string names = "$PhysicalNames\n2\n1 7 \"open\"\n1 8 \"land\"\n$EndPhysicalNames\n";
  const std::string nodes = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";
  const MeshFile two =
      read_text(scratch / "a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names + nodes +
                                       "$Elements\n4\n1 1 2 7 1 1 2\n2 1 2 8 2 2 3\n3 1 2 8 3 3 1\n"
                                       "4 2 2 9 1 1 2 3\n$EndElements\n");
  CHECK(field_of(two, "open")->values == DoubleVector{{1, 1, 0}});
  CHECK(rules_violated(scratch / "a.msh").empty());
  const std::string four_nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n";
  read_text(scratch / "a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names + four_nodes +
                                   "$Elements\n3\n1 1 2 7 1 2 4\n2 2 2 9 1 1 2 3\n3 2 2 9 1 1 3 4\n"
                                   "$EndElements\n");
  CHECK(rules_violated(scratch / "a.msh").size() == 1);
  const MeshFile four = read_text(
      scratch / "a.msh",
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names +
          "$Entities\n1 2 1 0\n5 0 0 0 0\n3 0 0 0 1 1 0 1 7 2 5 -5\n4 0 0 0 1 1 0 2 8 9 0\n"
          "1 0 0 0 1 1 0 0 0\n$EndEntities\n"
          "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n"
          "$Elements\n3 4 1 4\n1 3 1 1\n1 1 2\n1 4 1 2\n2 2 3\n3 3 1\n2 1 2 1\n4 1 2 "
          "3\n$EndElements\n");
  CHECK(field_of(four, "open")->values == DoubleVector{{1, 1, 0}});
  CHECK(rules_violated(scratch / "a.msh").empty());
}

TEST_CASE("damaged files end in one line that names the line and the remedy") {
  const Scratch scratch;
  const std::string gr3 = scratch / "a.gr3", sms = scratch / "a.2dm";
  const auto says = [&](const std::string& text, const std::string& words) {
    const std::string problem = error_of([&] { read_text(gr3, text); }).what();
    CAPTURE(problem);
    CHECK(problem.find(words) != std::string::npos);
  };
  says("", "the file is empty");
  says("x\n", "the numbers of elements and nodes");
  says("x\n-1 3\n", "-1 is not a number of elements or nodes");
  says("x\n1 99999999999\n", "99999999999 is not a number of elements or nodes");
  says("x\n1 2\n1 0 0 0\n3 1 1 1\n", "line 4: node 2 has another id; number the nodes from 1 on");
  says("x\n1 1\n1 402672 282928 20\n", "give the grid of the sphere, such as hgrid.ll");
  says("x\n1 1\n1 0 0\n", "line 3");
  says("x\n1 1\n1 0 0 nan\n", "line 3");
  says("x\n1 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n1 4 1 2 3 3\n",
       "line 6: an element of 4 nodes; only triangles are read");
  says("x\n1 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n1 3 1 2 4\n", "line 6");
  says("x\n1 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n1 3 1 2 -9999999999\n", "line 6");
  says(ring_grid("0\n0\n1\n3\n3 0\n1\n2\n7\n"), "line 22");
  says(ring_grid("0\n0\n1\n3\n-3 0\n1\n"), "-3 is not a number of nodes");
  says(ring_grid("0\n0\n1\n3\n3 0\n1\n2\n"), "node 3 of 3");
  says(ring_grid("1\n"), "the number of nodes of open boundaries");
  says(ring_grid("9999999999\n0\n"), "9999999999 is not a number of boundaries");
  const auto sms_says = [&](const std::string& text, const std::string& words) {
    const std::string problem = error_of([&] { read_text(sms, text); }).what();
    CAPTURE(problem);
    CHECK(problem.find(words) != std::string::npos);
  };
  sms_says("", "MESH2D");
  sms_says("ND 1 0 0 0\n", "line 1: the file does not begin with the card MESH2D");
  const std::string nodes = "MESH2D\nND 1 0 0 0\nND 2 1 0 0\nND 3 0 1 0\n";
  sms_says(nodes + "E4Q 1 1 2 3 3 1\n", "line 5: the card E4Q; only triangles, E3T, are read");
  sms_says(nodes + "E3T 1 1 2 4 1\n", "line 5: the triangle has node 4, but there are 3 nodes");
  sms_says(nodes + "E3T 1 1 2 3 1\nNS 1 2 3\n", "line 6: the string of nodes has no end");
  sms_says(nodes + "E3T 1 1 2 3 1\nNS 1 2 -4\n", "line 6: the string has node 4");
  sms_says(nodes + "E3T 1 1 2 3 1\nNS 1 0 -4\n", "line 6: 0 is no id of a node");
  sms_says(nodes + "E3T 1 1 2 3 1\nNS 1 1e300 -4\n", "is no id of a node");

  const Mesh mesh = delaunay(upper_half(12, 4));
  for (const CoastalFormat& kind : coastal_formats) {
    CAPTURE(kind.name);
    const std::string path = scratch / kind.name;
    write(path, mesh, {.format = kind.format, .open_sites = Ids{{0, 1, 2}}});
    done_when_cut(path, [&] { check_file(path, read_mesh_file(path)); });
  }
}

TEST_CASE("FESOM: flags at the boundary, two neighbours, and the depths of its own nodes") {
  const Scratch scratch;
  const Mesh mesh = sea_with_island();
  const DoubleVector depth = DoubleVector::LinSpaced(mesh.points.cols(), 5, 500);
  const std::string path = scratch / "nod2d.out";
  write(path, mesh, {.depth_levels = DoubleVector{{0, 10, 500}}, .site_depth = depth});
  CHECK(rules_violated(path).empty());
  CHECK(field_of(read_mesh_file(path), "depth")->values == depth);
  std::string nodes = read_file(path);
  const std::size_t flag = nodes.find(" 1\n", nodes.find('\n') + 1);
  std::string wrong = nodes;
  wrong[flag + 1] = '0';
  write_text(path, wrong);
  CHECK(rules_violated(path).size() == 1);
  CHECK(rules_violated(path).front().starts_with(
      "coast: flags other than 0 stand at the boundary; node "));
  write_text(path, nodes);
  write(path, delaunay(upper_half(60, 4))); // beside the depths of the other mesh
  CHECK(field_of(read_mesh_file(path), "depth") == nullptr);
  CHECK(read_mesh_file(path).ignored == std::vector<std::string>{"aux3d.out, of other nodes"});
  write_text(scratch / "aux3d.out", "3\n0 x\n");
  CHECK(error_of([&] { read_mesh_file(path); }).code() == ErrorCode::parse);
}
