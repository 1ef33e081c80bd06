// The exposure of a picture for a display, chosen from a small picture of the same view. Photographers know it as
// metering: Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002, section 3.1, maps the
// log-average of a picture to middle grey. Here it is the median of what is looked at, as backgrounds must not count.
#pragma once

#include "render/renderer.h"
#include "scene/description/description.h"

namespace lancer {

// Stops by which a picture is brightened. It depends on the scene, the view, the size of the whole picture and the
// render settings but for the number of samples. So a crop, a pass and a shard have the exposure of the whole picture.
// Rounded to a tenth of a stop. 0 if nothing in the picture has light.
//
// The small picture has about 3000 pixels with 32 samples. The objects are what is not a light, a plane or background;
// where there are none, all that is seen. Their median luminance becomes a middle value: 0.21 for a median base colour
// of 0.4, lighter for light objects and darker for dark ones (0.12 for 0.1, 0.28 for 0.8). It gets darker, down to
// 0.08, where more than a twelfth of the objects would be burnt out.
//
// Must be called inside with_threads.
float auto_exposure(const Renderer& renderer, const CameraDescription& view, PictureSize size, PixelGrid grid);

}  // namespace lancer
