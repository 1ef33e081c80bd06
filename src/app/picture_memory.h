// What --memory says, for those who read and build pictures.
#pragma once

#include "app/options/options.h"
#include "io/image/source.h"
#include "scene/build/picture_memory.h"

namespace lancer {

// A part is one of the memory that this process can have; see memory_bytes(). An eighth is for reading ahead.
PictureMemory memory_for(const MemorySize& size, unsigned threads);

// Lets `memory` ask this source, which must live as long, for headers and pictures.
void serve(PictureMemory& memory, ImageSource& images);

}  // namespace lancer
