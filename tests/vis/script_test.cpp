// The ParaView script: what it must contain, that Python accepts it. (That ParaView runs it: docs, by hand or
// the end-to-end tests.)
#include <gtest/gtest.h>

#include <cstdlib>

#include "sim/core/errors.hpp"
#include "tests/vis/sample.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis {
namespace {

TEST(ParaViewScript, CarriesTheRunsRangesAndNoFolder) {
  const sample::Folder folder;
  write_paraview_script(
      folder / "view_in_paraview.py", "grass",
      {{"water", {0.125, 0.875}}, {"stress_vein_MPa", {-0.5, 4}}, {"tissue", {2, 2}}, {"normal", {-1, 1}}});
  const std::string script = sample::content(folder / "view_in_paraview.py");
  EXPECT_NE(
      script.find("('water', 'Relative water content', '1', 0.125, 0.875, 'Viridis (matplotlib)', True)"),
      std::string::npos);
  EXPECT_NE(script.find(
                "('stress_vein_MPa', 'Stress in the vein', 'MPa', -4, 4, 'Cool to Warm (Extended)', False)"),
            std::string::npos);
  EXPECT_NE(script.find("'tissue', 'Tissue (0 air, 1 vein, 2 mesophyll)', '1', 2, 3,"),
            std::string::npos);  // never empty
  EXPECT_EQ(script.find("'normal'"), std::string::npos);
  EXPECT_EQ(script.find(folder.path().string()), std::string::npos);
  EXPECT_NE(script.find("SERIES = 'grass.pvd'"), std::string::npos);
}

TEST(ParaViewScript, IsPython) {
  if (std::system("python3 --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "python3 is not installed";
  const sample::Folder folder;
  for (const char* kind : {"grass", "leaf", "fruit", "floor"}) {
    write_paraview_script(folder / "v.py", kind, {{"water", {0, 1}}});
    const std::string command =
        "python3 -c \"import ast, sys; ast.parse(open(sys.argv[1]).read())\" " + (folder / "v.py").string();
    EXPECT_EQ(std::system(command.c_str()), 0) << kind;
  }
  EXPECT_THROW(write_paraview_script(folder / "v.py", "moss", {}), InvalidInput);
}

}  // namespace
}  // namespace witherfield::vis
