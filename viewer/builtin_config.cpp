#include "viewer/builtin_config.h"

namespace lumivec {

// clang-format off
std::string_view builtin_config() {
  return R"ocio(ocio_profile_version: 2

environment: {}
search_path: ""
strictparsing: true
luma: [0.2126, 0.7152, 0.0722]
name: lumivec

roles:
  default: lin_rec709
  scene_linear: lin_rec709
  reference: aces2065_1
  aces_interchange: aces2065_1
  cie_xyz_d65_interchange: cie_xyz_d65
  rendering: lin_rec709
  data: raw
  texture_paint: srgb_tx
  color_picking: srgb_tx
  matte_paint: srgb_tx
  color_timing: acescct

file_rules:
  - !<Rule> {name: Default, colorspace: default}

shared_views:
  - !<View> {name: ACES 1.0 SDR-video, view_transform: ACES 1.0 SDR-video, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: Un-tone-mapped, view_transform: Un-tone-mapped, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: Raw, colorspace: raw}

displays:
  sRGB:
    - !<Views> [ACES 1.0 SDR-video, Un-tone-mapped, Raw]
  Display P3:
    - !<Views> [ACES 1.0 SDR-video, Un-tone-mapped, Raw]
  Rec.1886 Rec.709:
    - !<Views> [ACES 1.0 SDR-video, Un-tone-mapped, Raw]

active_displays: [sRGB, Display P3, Rec.1886 Rec.709]
active_views: [ACES 1.0 SDR-video, Un-tone-mapped, Raw]

default_view_transform: Un-tone-mapped

view_transforms:
  - !<ViewTransform>
    name: ACES 1.0 SDR-video
    from_scene_reference: !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}

  - !<ViewTransform>
    name: Un-tone-mapped
    from_scene_reference: !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}

display_colorspaces:
  - !<ColorSpace>
    name: sRGB
    family: Display
    encoding: sdr-video
    bitdepth: unknown
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}

  - !<ColorSpace>
    name: Display P3
    family: Display
    encoding: sdr-video
    bitdepth: unknown
    from_display_reference: !<GroupTransform>
      children:
        - !<MatrixTransform> {matrix: [2.493496911941425, -0.931383617919124, -0.402710784450717, 0, -0.829488969561575, 1.762664060318346, 0.023624685841943, 0, 0.035845830243784, -0.076172389268041, 0.956884524007687, 0, 0, 0, 0, 1]}
        - !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}

  - !<ColorSpace>
    name: Rec.1886 Rec.709
    family: Display
    encoding: sdr-video
    bitdepth: unknown
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_REC.1886-REC.709}

  - !<ColorSpace>
    name: cie_xyz_d65
    aliases: [CIE-XYZ-D65]
    family: Display
    encoding: display-linear
    bitdepth: 32f

colorspaces:
  - !<ColorSpace>
    name: aces2065_1
    aliases: [ACES2065-1]
    family: ACES
    encoding: scene-linear
    bitdepth: 32f

  - !<ColorSpace>
    name: acescg
    aliases: [ACEScg, lin_ap1]
    family: ACES
    encoding: scene-linear
    bitdepth: 32f
    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}

  - !<ColorSpace>
    name: acescct
    aliases: [ACEScct]
    family: ACES
    encoding: log
    bitdepth: 32f
    to_scene_reference: !<BuiltinTransform> {style: ACEScct_to_ACES2065-1}

  - !<ColorSpace>
    name: lin_rec709
    aliases: [Linear Rec.709 (sRGB), lin_srgb]
    family: Utility
    encoding: scene-linear
    bitdepth: 32f
    from_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1, direction: inverse}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}

  - !<ColorSpace>
    name: srgb_tx
    aliases: [sRGB - Texture, srgb_texture]
    family: Texture
    encoding: sdr-video
    bitdepth: 32f
    from_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1, direction: inverse}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}
        - !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}

  - !<ColorSpace>
    name: raw
    aliases: [Raw]
    family: Utility
    isdata: true
    bitdepth: 32f
)ocio";
}
// clang-format on

}  // namespace lumivec
