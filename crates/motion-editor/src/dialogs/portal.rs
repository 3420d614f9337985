//! Whether the desktop has file dialogs.

/// Whether a portal answers that has a file dialog.
///
/// Asking for a property of the dialog's interface tells more than the portal's name on the bus: a
/// portal whose desktop brings no file dialog has the name and not the interface. Starts the portal
/// where it can be started; may take as long as that, so it is no question for the window's thread.
#[cfg(target_os = "linux")]
pub(super) fn has_file_dialog() -> bool {
    let ask = || -> zbus::Result<u32> {
        let bus = zbus::blocking::connection::Builder::session()?
            .method_timeout(std::time::Duration::from_secs(3))
            .build()?;
        let portal = zbus::blocking::Proxy::new(
            &bus,
            "org.freedesktop.portal.Desktop",
            "/org/freedesktop/portal/desktop",
            "org.freedesktop.portal.FileChooser",
        )?;
        portal.get_property("version")
    };
    ask().is_ok()
}

/// Every other system has them.
#[cfg(not(target_os = "linux"))]
pub(super) fn has_file_dialog() -> bool {
    true
}
