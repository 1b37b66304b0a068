import { mount } from 'svelte';
import App from './App.svelte';
import { language } from './lib/language';
import './style.css';

document.documentElement.lang = language;
mount(App, { target: document.getElementById('page')! });
