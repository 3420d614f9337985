//! All WGSL there is, with the parts that several shaders share put before each.

const FRAME: &str = include_str!("../../../shaders/common/frame.wgsl");
const SHADOW: &str = include_str!("../../../shaders/common/shadow.wgsl");
const LIGHTING: &str = include_str!("../../../shaders/common/lighting.wgsl");
const BODY: &str = include_str!("../../../shaders/common/body.wgsl");
const SKINNING: &str = include_str!("../../../shaders/common/skinning.wgsl");

/// One shader module: its file's name and the parts it is made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShaderSource {
    /// The file in `/shaders`, without its ending.
    pub(crate) name: &'static str,
    parts: &'static [&'static str],
}

macro_rules! shaders {
    ($($constant:ident = $name:literal with $($part:ident),*;)*) => {
        $(
            pub(crate) const $constant: ShaderSource = ShaderSource {
                name: $name,
                parts: &[
                    $($part,)*
                    include_str!(concat!("../../../shaders/", $name, ".wgsl")),
                ],
            };
        )*
        /// All of them.
        #[cfg(test)]
        const ALL: &[ShaderSource] = &[$($constant),*];
    };
}

shaders! {
    SKINNED_MESH = "skinned_mesh" with FRAME, SHADOW, LIGHTING, SKINNING, BODY;
    SKINNED_SHADOW = "skinned_shadow" with FRAME, SKINNING, BODY;
    SKINNED_POSITIONS = "skinned_positions" with SKINNING;
    SOLIDS = "solids" with FRAME, SHADOW, LIGHTING;
    SOLIDS_SHADOW = "solids_shadow" with FRAME;
    GROUND = "ground" with FRAME;
    GROUND_SHADE = "ground_shade" with FRAME, SHADOW;
    SKY = "sky" with FRAME;
    FLATS = "flats" with FRAME;
    LINES = "lines" with FRAME;
    LABELS = "labels" with FRAME;
    OUTLINE = "outline" with FRAME;
}

impl ShaderSource {
    /// The whole module.
    pub(crate) fn text(&self) -> String {
        self.parts.join("\n")
    }

    /// The module on a device.
    pub(crate) fn module(&self, device: &wgpu::Device) -> wgpu::ShaderModule {
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(self.name),
            source: wgpu::ShaderSource::Wgsl(self.text().into()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Shaders are compiled when a device first needs them; this needs no device.
    #[test]
    fn every_shader_is_valid() {
        for shader in ALL {
            let text = shader.text();
            let module = naga::front::wgsl::parse_str(&text)
                .unwrap_or_else(|e| panic!("{}: {}", shader.name, e.emit_to_string(&text)));
            let mut validator = naga::valid::Validator::new(
                naga::valid::ValidationFlags::all(),
                naga::valid::Capabilities::empty(),
            );
            if let Err(error) = validator.validate(&module) {
                panic!("{}: {}", shader.name, error.emit_to_string(&text));
            }
        }
    }

    /// A file that no pipeline uses would never be checked.
    #[test]
    fn every_file_is_listed() {
        let dir = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shaders");
        let mut files: Vec<String> = std::fs::read_dir(dir)
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .filter(|path| path.extension().is_some_and(|ending| ending == "wgsl"))
            .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
            .collect();
        files.sort();
        let mut listed: Vec<&str> = ALL.iter().map(|shader| shader.name).collect();
        listed.sort_unstable();
        assert_eq!(files, listed);
    }
}
