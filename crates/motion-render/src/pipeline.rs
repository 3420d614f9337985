//! Render pipelines from the few choices in which ours differ.

use crate::gpu::Gpu;
use crate::shader_source::ShaderSource;

/// What scenes are drawn into: stored sRGB values. Light is computed as light and encoded by the
/// shaders; edges and see-through things are mixed as stored values, as user interfaces do. (A
/// format that encodes would do it for each of four samples; in software that is a fifth of a
/// picture's time.)
pub(crate) const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Depth, reversed: 1 near, 0 far.
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Names of what is seen.
pub(crate) const ID_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;
/// Where something is selected or hovered.
pub(crate) const MASK_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg8Unorm;
/// Samples of a pixel.
pub(crate) const N_SAMPLES: u32 = 4;

/// What a pipeline draws into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Output {
    /// The picture.
    Color(Blend),
    /// Only its depth.
    DepthOfColor,
    /// The map of the key light.
    ShadowMap,
    /// Names.
    Ids,
    /// The mask of outlines.
    Mask,
}

/// How a color meets what is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Blend {
    /// It replaces it.
    Replace,
    /// By its alpha.
    Over,
    /// It darkens it.
    Multiply,
}

/// What a pipeline does with depth in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Depth {
    /// Hidden by what is nearer, hides what is further.
    TestAndWrite,
    /// Hidden by what is nearer.
    Test,
    /// Seen through everything.
    Ignore,
}

/// A pipeline.
pub(crate) struct PipelineSpec<'a> {
    /// The shader and its entry points.
    pub(crate) shader: ShaderSource,
    pub(crate) vertex: &'a str,
    /// `None` where only depth is drawn.
    pub(crate) fragment: Option<&'a str>,
    /// By group.
    pub(crate) groups: &'a [Option<&'a wgpu::BindGroupLayout>],
    pub(crate) buffers: &'a [wgpu::VertexBufferLayout<'a>],
    pub(crate) topology: wgpu::PrimitiveTopology,
    /// Whether triangles are seen from their backs.
    pub(crate) cull: bool,
    pub(crate) output: Output,
    pub(crate) depth: Depth,
}

impl PipelineSpec<'_> {
    /// Makes it.
    pub(crate) fn create(&self, gpu: &Gpu) -> wgpu::RenderPipeline {
        let module = self.shader.module(gpu.device());
        let label = format!("{}.{}", self.shader.name, self.fragment.unwrap_or(self.vertex));
        let layout = gpu.device().create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(&label),
            bind_group_layouts: self.groups,
            immediate_size: 0,
        });
        let target = self.color_target().map(Some);
        let buffers: Vec<Option<wgpu::VertexBufferLayout<'_>>> =
            self.buffers.iter().cloned().map(Some).collect();
        gpu.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(&label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(self.vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState {
                topology: self.topology,
                cull_mode: self.cull.then_some(wgpu::Face::Back),
                ..Default::default()
            },
            depth_stencil: self.depth_state(),
            multisample: wgpu::MultisampleState {
                count: match self.output {
                    Output::Color(_) | Output::DepthOfColor | Output::Mask => N_SAMPLES,
                    Output::ShadowMap | Output::Ids => 1,
                },
                ..Default::default()
            },
            fragment: self.fragment.map(|entry_point| wgpu::FragmentState {
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: target.as_slice(),
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    fn color_target(&self) -> Option<wgpu::ColorTargetState> {
        let multiply = wgpu::BlendState {
            color: wgpu::BlendComponent {
                src_factor: wgpu::BlendFactor::Dst,
                dst_factor: wgpu::BlendFactor::Zero,
                operation: wgpu::BlendOperation::Add,
            },
            alpha: wgpu::BlendComponent::OVER,
        };
        let mut write_mask = wgpu::ColorWrites::ALL;
        let (format, blend) = match self.output {
            Output::DepthOfColor => {
                write_mask = wgpu::ColorWrites::empty();
                (COLOR_FORMAT, None)
            }
            Output::Color(Blend::Replace) => (COLOR_FORMAT, None),
            Output::Color(Blend::Over) => (COLOR_FORMAT, Some(wgpu::BlendState::ALPHA_BLENDING)),
            Output::Color(Blend::Multiply) => (COLOR_FORMAT, Some(multiply)),
            Output::Ids => (ID_FORMAT, None),
            Output::Mask => (MASK_FORMAT, None),
            Output::ShadowMap => return None,
        };
        Some(wgpu::ColorTargetState { format, blend, write_mask })
    }

    fn depth_state(&self) -> Option<wgpu::DepthStencilState> {
        if self.output == Output::Mask {
            return None;
        }
        let nearer = match self.output {
            // The light's depth is not reversed: its map is parallel and needs no more precision.
            Output::ShadowMap => wgpu::CompareFunction::Less,
            _ => wgpu::CompareFunction::GreaterEqual,
        };
        let bias = match self.output {
            Output::ShadowMap => wgpu::DepthBiasState { constant: 0, slope_scale: 1.5, clamp: 0.0 },
            _ => wgpu::DepthBiasState::default(),
        };
        Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(self.depth == Depth::TestAndWrite),
            depth_compare: Some(match self.depth {
                Depth::TestAndWrite | Depth::Test => nearer,
                Depth::Ignore => wgpu::CompareFunction::Always,
            }),
            stencil: wgpu::StencilState::default(),
            bias,
        })
    }
}

/// A layout of bindings 0, 1, …, each seen by the stages it names.
pub(crate) fn bind_group_layout(
    gpu: &Gpu,
    label: &str,
    bindings: &[(wgpu::ShaderStages, wgpu::BindingType)],
) -> wgpu::BindGroupLayout {
    let entries: Vec<wgpu::BindGroupLayoutEntry> = (0..)
        .zip(bindings)
        .map(|(binding, &(visibility, ty))| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty,
            count: None,
        })
        .collect();
    gpu.device().create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(label),
        entries: &entries,
    })
}

/// A uniform buffer.
pub(crate) const UNIFORM: wgpu::BindingType = wgpu::BindingType::Buffer {
    ty: wgpu::BufferBindingType::Uniform,
    has_dynamic_offset: false,
    min_binding_size: None,
};

/// A storage buffer that is read.
pub(crate) const STORAGE: wgpu::BindingType = wgpu::BindingType::Buffer {
    ty: wgpu::BufferBindingType::Storage { read_only: true },
    has_dynamic_offset: false,
    min_binding_size: None,
};

/// A picture.
pub(crate) fn texture_binding(sample_type: wgpu::TextureSampleType) -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    }
}
