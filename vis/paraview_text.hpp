// The Python text of ParaView's start-up script, in the order in which it is put together: head, the run's table
// (FIELDS, SERIES), common, one kind, main. What depends on the run is in the table alone.
#pragma once

namespace witherfield::vis::paraview_text {

extern const char* const kHead;
extern const char* const kCommon;
extern const char* const kGrass;
extern const char* const kSurface;  ///< leaves and fruit: a series of triangle meshes
extern const char* const kFloor;    ///< a series of flat images
extern const char* const kMain;

}  // namespace witherfield::vis::paraview_text
