#pragma once

#include <span>
#include <string>

namespace listric {

/// Content of a DataArray of format "binary" in a VTK XML file with header_type UInt64 and
/// compressor vtkZLibDataCompressor: sizes, then the bytes, both in base64.
std::string vtk_array(std::span<const unsigned char> bytes);

} // namespace listric
