//! The device that draws, and how it is chosen.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Which adapter will do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum AdapterChoice {
    /// The fastest there is; a software one where there is no other.
    #[default]
    Any,
    /// A software one first: the same picture wherever it is drawn, as tests want it.
    Software,
}

/// No adapter draws here.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no graphics adapter can draw here ({0}); install a driver, or software Vulkan \
     (Debian and Ubuntu: mesa-vulkan-drivers libvulkan1)"
)]
pub struct NoAdapter(String);

/// What has been made on a device so far. In steady state none of it grows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Created {
    /// Buffers.
    pub buffers: u64,
    /// Textures.
    pub textures: u64,
    /// Render pipelines.
    pub pipelines: u64,
    /// Bind groups.
    pub bind_groups: u64,
}

#[derive(Debug, Default)]
struct Counters {
    buffers: AtomicU64,
    textures: AtomicU64,
    pipelines: AtomicU64,
    bind_groups: AtomicU64,
}

/// A device and its queue. Clones are the same device.
#[derive(Clone, Debug)]
pub struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    adapter_name: String,
    is_software: bool,
    counters: Arc<Counters>,
    is_lost: Arc<AtomicBool>,
}

impl Gpu {
    /// Takes an adapter and opens a device on it. `WGPU_BACKEND` and `WGPU_ADAPTER_NAME` narrow the
    /// choice.
    pub fn open(choice: AdapterChoice) -> Result<Self, NoAdapter> {
        pollster::block_on(Self::open_async(choice))
    }

    async fn open_async(choice: AdapterChoice) -> Result<Self, NoAdapter> {
        let no_adapter = |error: &dyn std::fmt::Display| {
            NoAdapter(error.to_string().lines().next().unwrap_or_default().to_owned())
        };
        let allowed = wgpu::Backends::from_env().unwrap_or_default();
        // OpenGL without a window cannot be had everywhere, and its libraries complain on the
        // terminal: only where there is nothing better.
        let better = allowed.difference(wgpu::Backends::GL);
        let adapter = match best_adapter(better, choice).await {
            Some(adapter) => adapter,
            None => best_adapter(allowed.intersection(wgpu::Backends::GL), choice)
                .await
                .ok_or_else(|| no_adapter(&"no Vulkan, Metal, Direct3D or OpenGL driver"))?,
        };
        let info = adapter.get_info();
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                label: Some("gaitway"),
                required_limits: required_limits(&adapter.limits()),
                ..Default::default()
            })
            .await
            .map_err(|error| no_adapter(&error))?;
        Ok(Self::from_parts(device, queue, &info, || ()))
    }

    /// Draws with a device that somebody else opened and owns, with at least the limits of
    /// [`required_limits`]. `wake` is called from any thread when it turns out to be lost.
    pub fn from_parts(
        device: wgpu::Device,
        queue: wgpu::Queue,
        adapter: &wgpu::AdapterInfo,
        wake: impl Fn() + Send + 'static,
    ) -> Self {
        let is_lost = Arc::new(AtomicBool::new(false));
        let lost = Arc::clone(&is_lost);
        device.set_device_lost_callback(move |_, _| {
            lost.store(true, Ordering::Release);
            wake();
        });
        Self {
            device,
            queue,
            adapter_name: format!("{} ({})", adapter.name, adapter.backend),
            is_software: adapter.device_type == wgpu::DeviceType::Cpu,
            counters: Arc::default(),
            is_lost,
        }
    }

    /// The device.
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// Its queue.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }

    /// What draws, for a person.
    pub fn adapter_name(&self) -> &str {
        &self.adapter_name
    }

    /// Whether the processor does the drawing.
    pub fn is_software(&self) -> bool {
        self.is_software
    }

    /// Whether the device has gone: driver reset, adapter unplugged, destroyed. All that was made
    /// on it is gone, too.
    pub fn is_lost(&self) -> bool {
        self.is_lost.load(Ordering::Acquire)
    }

    /// What has been made so far.
    pub fn created(&self) -> Created {
        let read = |counter: &AtomicU64| counter.load(Ordering::Relaxed);
        Created {
            buffers: read(&self.counters.buffers),
            textures: read(&self.counters.textures),
            pipelines: read(&self.counters.pipelines),
            bind_groups: read(&self.counters.bind_groups),
        }
    }

    pub(crate) fn create_buffer(&self, desc: &wgpu::BufferDescriptor<'_>) -> wgpu::Buffer {
        self.counters.buffers.fetch_add(1, Ordering::Relaxed);
        self.device.create_buffer(desc)
    }

    pub(crate) fn create_texture(&self, desc: &wgpu::TextureDescriptor<'_>) -> wgpu::Texture {
        self.counters.textures.fetch_add(1, Ordering::Relaxed);
        self.device.create_texture(desc)
    }

    pub(crate) fn create_render_pipeline(
        &self,
        desc: &wgpu::RenderPipelineDescriptor<'_>,
    ) -> wgpu::RenderPipeline {
        self.counters.pipelines.fetch_add(1, Ordering::Relaxed);
        self.device.create_render_pipeline(desc)
    }

    pub(crate) fn create_bind_group(
        &self,
        label: &str,
        layout: &wgpu::BindGroupLayout,
        resources: &[wgpu::BindingResource<'_>],
    ) -> wgpu::BindGroup {
        self.counters.bind_groups.fetch_add(1, Ordering::Relaxed);
        let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
            .collect();
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(label),
            layout,
            entries: &entries,
        })
    }
}

/// What a device must be able to do: the usual, with textures and buffers as large as it can.
pub fn required_limits(of_adapter: &wgpu::Limits) -> wgpu::Limits {
    wgpu::Limits {
        max_texture_dimension_2d: of_adapter.max_texture_dimension_2d,
        max_buffer_size: of_adapter.max_buffer_size,
        max_storage_buffer_binding_size: of_adapter.max_storage_buffer_binding_size,
        ..wgpu::Limits::downlevel_defaults()
    }
}

async fn best_adapter(backends: wgpu::Backends, choice: AdapterChoice) -> Option<wgpu::Adapter> {
    if backends.is_empty() {
        return None;
    }
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends,
        ..wgpu::InstanceDescriptor::new_without_display_handle_from_env()
    });
    let wanted = std::env::var("WGPU_ADAPTER_NAME").unwrap_or_default().to_lowercase();
    let mut adapters = instance.enumerate_adapters(backends).await;
    adapters.retain(|adapter| adapter.get_info().name.to_lowercase().contains(&wanted));
    // Stable: of equals the first, which the driver's loader prefers.
    adapters.sort_by_key(|adapter| rank(adapter.get_info().device_type, choice));
    adapters.into_iter().next()
}

fn rank(device_type: wgpu::DeviceType, choice: AdapterChoice) -> u8 {
    use wgpu::DeviceType as D;
    let by_speed = match device_type {
        D::DiscreteGpu => 1,
        D::IntegratedGpu => 2,
        D::VirtualGpu => 3,
        D::Other => 4,
        D::Cpu => 5,
    };
    if choice == AdapterChoice::Software && device_type == D::Cpu { 0 } else { by_speed }
}
